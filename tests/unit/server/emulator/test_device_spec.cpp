#include "server/emulator/device_spec.hpp"

#include <gtest/gtest.h>

namespace seeker::emulator {
namespace {

TEST(DeviceSpec, IsAKindOnAPseudoTerminal) {
  EXPECT_EQ(parse_device_spec("p2os@/tmp/base").value(), (DeviceSpec{DeviceKind::kP2os, "/tmp/base", "", 0, 0}));
}

TEST(DeviceSpec, IsAKindOnATcpPortOfAnotherRobot) {
  EXPECT_EQ(parse_device_spec("lms200@tcp://127.0.0.1:8102#3").value(),
            (DeviceSpec{DeviceKind::kLms200, "", "127.0.0.1", 8102, 3}));
}

TEST(DeviceSpec, RefusesWhatIsNoneAndNamesTheKinds) {
  for (const std::string text : {"", "p2os", "@/tmp/x", "lidar@/tmp/x", "p2os@", "p2os@tcp://", "p2os@tcp://h",
                                 "p2os@tcp://h:x", "p2os@tcp://h:99999", "p2os@/tmp/x#y", "camera@/tmp/x"}) {
    const auto spec = parse_device_spec(text);
    ASSERT_FALSE(spec) << text;
    EXPECT_NE(spec.error().message.find("rplidar-a1"), std::string::npos) << spec.error().message;
  }
}

}  // namespace
}  // namespace seeker::emulator
