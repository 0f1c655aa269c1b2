#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/angle.hpp"
#include "server/protocols/p2os/gyro_packet.hpp"
#include "tests/unit/server/protocols/p2os/hex.hpp"

namespace seeker::p2os {
namespace {

TEST(P2osGyroPacket, TheReadingsFollowTheirCount) {
  const auto readings = read_gyro({0x98, hex("02 00 02 19 FF 01 1A")});
  ASSERT_TRUE(readings);
  EXPECT_EQ(*readings, (std::vector<GyroReading>{{512, 25}, {511, 26}}));
}

TEST(P2osGyroPacket, APacketThatEndsBeforeItsLastReadingIsCorrupt) {
  EXPECT_EQ(read_gyro({0x98, hex("02 00 02 19 FF 01")}).error().code, Errc::kCorrupt);
  EXPECT_EQ(read_gyro({0x98, {}}).error().code, Errc::kCorrupt);
}

TEST(P2osGyroPacket, ACountIsTheRotationOfTheManual) {
  EXPECT_NEAR(rad_to_deg(gyro_rad_s_per_count(1.626)), 5.0 / 1023.0 * 300.0 / 2.5 * 1.626, 1e-12);
}

RC_GTEST_PROP(P2osGyroPacket, AnyReadingsComeBack, (std::vector<std::pair<std::uint16_t, std::uint8_t>> values)) {
  values.resize(std::min(values.size(), kMaxGyroReadings));
  std::vector<GyroReading> readings;
  readings.reserve(values.size());
  for (const auto& [rate, temperature] : values) {
    readings.push_back({rate, temperature});
  }
  RC_ASSERT(*read_gyro(write_gyro(readings)) == readings);
}

}  // namespace
}  // namespace seeker::p2os
