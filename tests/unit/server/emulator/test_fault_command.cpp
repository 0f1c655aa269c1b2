#include "server/emulator/fault_command.hpp"

#include <gtest/gtest.h>

namespace seeker::emulator {
namespace {

TEST(FaultCommand, BeginsAtATimeAndLastsAWhile) {
  EXPECT_EQ(parse_fault_command("20 lms200 unplug for 2").value(),
            (FaultCommand{robot_time_s(20.0), "lms200", "unplug", 0.0, seconds(2.0)}));
}

TEST(FaultCommand, MayHaveAValueAndStay) {
  EXPECT_EQ(parse_fault_command("0 p2os bit-errors 1e-6").value(),
            (FaultCommand{robot_time_s(0.0), "p2os", "bit-errors", 1e-6, Duration{}}));
}

TEST(FaultCommand, RefusesWhatIsNoneAndShowsTheForm) {
  for (const std::string text : {"", "20", "20 lms200", "x lms200 unplug", "20 lms200 unplug for", "-1 lms200 unplug",
                                 "20 lms200 unplug for x", "20 lms200 bit-errors nan", "1 2 3 4 5 6 7"}) {
    const auto command = parse_fault_command(text);
    ASSERT_FALSE(command) << text;
    EXPECT_NE(command.error().message.find("unplug for 2"), std::string::npos);
  }
}

}  // namespace
}  // namespace seeker::emulator
