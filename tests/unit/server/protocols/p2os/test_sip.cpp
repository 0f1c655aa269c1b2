#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/rng.hpp"
#include "server/protocols/p2os/sip.hpp"
#include "tests/unit/server/protocols/p2os/hex.hpp"

namespace seeker::p2os {
namespace {

/// x = 0x8123 with the unused bit set, heading -2, 100 and -100 mm/s, 12.6 V, left wheel and bumper 1 at the rear.
const char* const kSip =
    "23 81 FF 7F FE FF 64 00 9C FF 7E 03 80 10 00 21 04 5A 02 00 D2 04 0F 88 13 AA BB CC DD EE 7F 00 01 C4 FF";

TEST(P2osSip, TheFieldsStandWhereTheManualPutsThem) {
  const auto sip = read_sip({0x33, hex(kSip)});
  ASSERT_TRUE(sip);
  EXPECT_TRUE(sip->moving);
  EXPECT_EQ(sip->x, 0x0123);
  EXPECT_EQ(sip->y, 0x7FFF);
  EXPECT_EQ(sip->theta, -2);
  EXPECT_EQ(sip->left_velocity, 100);
  EXPECT_EQ(sip->right_velocity, -100);
  EXPECT_EQ(sip->battery_dv, 126);
  EXPECT_EQ(sip->stall_left_rear, 0x03);
  EXPECT_EQ(sip->stall_right_front, 0x80);
  EXPECT_EQ(sip->control, 16);
  EXPECT_EQ(sip->flags, flag::kMotorsOn | flag::kEStop | flag::kChargerPower);
  EXPECT_EQ(sip->compass, 0x5A);
  EXPECT_EQ(sip->sonars, (std::vector<SipSonar>{{0, 1234}, {15, 5000}}));
  EXPECT_EQ(sip->ports, 0xBBAA);
  EXPECT_EQ(sip->digital_out, 0xEE);
  EXPECT_EQ(sip->battery_x10, 127);
  EXPECT_EQ(sip->charge_state, 1);
  EXPECT_EQ(sip->rotational_velocity, -60);
  EXPECT_FALSE(sip->fault_flags);
  EXPECT_FALSE(sip->flags3);
}

TEST(P2osSip, AHeaderOfAStoppedBaseSaysSo) { EXPECT_FALSE(read_sip({0x32, hex(kSip)})->moving); }

TEST(P2osSip, TheSipOfOldFirmwareHasNoTail) {
  auto data = hex(kSip);
  data.resize(19);
  data[18] = 0;
  const auto sip = read_sip({0x32, data});
  ASSERT_TRUE(sip);
  EXPECT_TRUE(sip->sonars.empty());
  EXPECT_FALSE(sip->ports);
}

TEST(P2osSip, ASipThatEndsBeforeItsSonarCountOrReadingsIsCorrupt) {
  auto data = hex(kSip);
  data.resize(24);
  EXPECT_EQ(read_sip({0x32, data}).error().code, Errc::kCorrupt);
  data.resize(18);
  EXPECT_EQ(read_sip({0x32, data}).error().code, Errc::kCorrupt);
}

TEST(P2osSip, BytesAfterTheLastFieldAreIgnored) {
  auto data = hex(kSip);
  data.insert(data.end(), 40, 0x55);
  const auto sip = read_sip({0x32, data});
  ASSERT_TRUE(sip);
  EXPECT_EQ(sip->flags3, 0x55555555U);
}

/// A SIP with any values and `tail` of its optional fields.
Sip random_sip(Rng& rng, int tail) {
  Sip sip;
  const auto u16 = [&] { return static_cast<std::uint16_t>(rng.bits()); };
  const auto u8 = [&] { return static_cast<std::uint8_t>(rng.bits()); };
  const auto fill = [&](auto& field) {
    if (tail-- > 0) {
      field = static_cast<std::decay_t<decltype(*field)>>(rng.bits());
    }
  };
  sip.moving = rng.below(2) == 1;
  sip.x = u16() & 0x7FFF, sip.y = u16() & 0x7FFF, sip.theta = static_cast<std::int16_t>(u16());
  sip.left_velocity = static_cast<std::int16_t>(u16()), sip.right_velocity = static_cast<std::int16_t>(u16());
  sip.battery_dv = u8(), sip.stall_left_rear = u8(), sip.stall_right_front = u8();
  sip.control = static_cast<std::int16_t>(u16()), sip.flags = u16(), sip.compass = u8();
  sip.sonars.resize(rng.below(kMaxSipSonars + 1));
  for (SipSonar& sonar : sip.sonars) {
    sonar = {static_cast<std::uint8_t>(u8()), u16()};
  }
  fill(sip.ports), fill(sip.analog), fill(sip.digital_in), fill(sip.digital_out), fill(sip.battery_x10);
  fill(sip.charge_state), fill(sip.rotational_velocity), fill(sip.fault_flags), fill(sip.lateral_velocity);
  fill(sip.temperature_c), fill(sip.charge_percent), fill(sip.controller_time_us), fill(sip.flags3);
  return sip;
}

RC_GTEST_PROP(P2osSip, AnySipComesBackWithAnyTail, (std::uint64_t seed)) {
  Rng rng(seed);
  const Sip sip = random_sip(rng, *rc::gen::inRange(0, 14));
  RC_ASSERT(*read_sip(write_sip(sip)) == sip);
  RC_ASSERT(encode(write_sip(sip)).size() <= kMaxPacketBytes);
}

}  // namespace
}  // namespace seeker::p2os
