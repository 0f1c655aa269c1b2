#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "server/protocols/p2os/config_packet.hpp"
#include "server/protocols/p2os/field_reader.hpp"
#include "server/protocols/p2os/gyro_packet.hpp"
#include "tests/unit/server/emulator/devices/p2os_device_fixture.hpp"

namespace seeker::emulator {
namespace {

using p2os::CommandId;
using p2os::PacketId;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST_F(P2osDeviceTest, TheConfigurationStatesLimitsWatchdogAndEquipment) {
  bench.connect();
  order(CommandId::kConfig, 1);
  const auto packets = bench.heard();
  ASSERT_EQ(packets.size(), 1U);
  const auto config = p2os::read_config(packets[0]);
  ASSERT_TRUE(config);
  EXPECT_EQ(config->subtype, "p3dx-sh");
  EXPECT_EQ(config->trans_vel_top, 900);
  EXPECT_EQ(config->rot_vel_max, 100);
  EXPECT_EQ(config->watchdog_ms, 2000);
  EXPECT_EQ(config->sip_cycle_ms, 100);
  EXPECT_EQ(config->front_bumps, 5);
  EXPECT_EQ(config->has_gyro, 0);
}

TEST_F(P2osDeviceTest, OnlyNewSonarReadingsAreSentAFewInEachPacketInTurn) {
  for (int k = 0; k < 8; ++k) {
    bench.sonar.readings.push_back({Pose2{}, k == 7 ? kNoReturn : static_cast<float>(k)});
  }
  bench.connect();
  EXPECT_THAT(bench.information().sonars,
              ElementsAre(p2os::SipSonar{0, 0}, p2os::SipSonar{1, 1000}, p2os::SipSonar{2, 2000}));
  EXPECT_THAT(bench.information().sonars,
              ElementsAre(p2os::SipSonar{3, 3000}, p2os::SipSonar{4, 4000}, p2os::SipSonar{5, 5000}));
  EXPECT_THAT(bench.information().sonars,
              ElementsAre(p2os::SipSonar{6, 5000}, p2os::SipSonar{7, 5000}, p2os::SipSonar{0, 0}));
  order(CommandId::kSonar, 0);
  EXPECT_THAT(bench.information().sonars, IsEmpty());
}

TEST_F(P2osDeviceTest, AStalledWheelCutsThePowerForAWhileAndThenMotionGoesOn) {
  bench.connect();
  order(CommandId::kVel, 300);
  bench.blocked = true;
  work(0.5);
  const p2os::Sip sip = bench.information();
  EXPECT_EQ(sip.stall_left_rear & p2os::kWheelStalled, p2os::kWheelStalled);
  EXPECT_EQ(sip.stall_right_front & p2os::kWheelStalled, p2os::kWheelStalled);
  EXPECT_EQ(bench.commanded, Twist2{});
  bench.blocked = false;
  work(2.0);
  EXPECT_GT(bench.commanded.v_m_s, 0.1);
  EXPECT_EQ(bench.information().stall_left_rear, 0);
}

TEST_F(P2osDeviceTest, OneStuckWheelShowsOnItsOwnSide) {
  bench.connect();
  bench.device.set_faults({.left_wheel_stuck = true});
  EXPECT_EQ(bench.information().stall_left_rear, 0);
  order(CommandId::kVel, 300);
  const p2os::Sip sip = bench.information();
  EXPECT_EQ(sip.stall_left_rear, p2os::kWheelStalled);
  EXPECT_EQ(sip.stall_right_front, 0);
}

TEST_F(P2osDeviceTest, AContactPressesTheBumpersOnItsSide) {
  bench.connect();
  bench.reading.bumped = true;
  EXPECT_NE(bench.information().stall_right_front & p2os::kBumpers, 0);
  bench.reading.bumped = false;
  EXPECT_EQ(bench.information().stall_right_front, 0);
  bench.contact_bearing_rad = deg_to_rad(170.0);
  bench.reading.bumped = true;
  const p2os::Sip rear = bench.information();
  EXPECT_EQ(rear.stall_right_front, 0);
  EXPECT_NE(rear.stall_left_rear & p2os::kBumpers, 0);
}

TEST_F(P2osDeviceTest, WithoutABearingAContactLiesWhereTheBaseWasGoing) {
  bench.connect();
  order(CommandId::kVel, -100);
  bench.pass(kTenth);
  bench.reading.bumped = true;
  EXPECT_NE(bench.information().stall_left_rear & p2os::kBumpers, 0);
  order(CommandId::kVel, 100);
  EXPECT_NE(bench.information().stall_left_rear & p2os::kBumpers, 0);
}

TEST_F(P2osDeviceTest, ABaseWithoutBumpersFeelsNoContact) {
  P2osDeviceParams params;
  params.has_front_bumpers = params.has_rear_bumpers = false;
  P2osBench bare(params);
  bare.connect();
  bare.reading.bumped = true;
  bare.device.set_faults({.front_bumpers = 0x02});
  EXPECT_EQ(bare.information().stall_right_front, 0);
}

TEST_F(P2osDeviceTest, ABumperStallsTheBaseWhereThatIsSet) {
  bench.connect();
  order(CommandId::kVel, 300);
  bench.device.set_faults({.front_bumpers = 0x02});
  work(0.5);
  EXPECT_GT(bench.commanded.v_m_s, 0.1);
  order(CommandId::kBumpStall, 1);
  bench.pass(kTenth);
  EXPECT_EQ(bench.commanded, Twist2{});
  EXPECT_EQ(bench.information().stall_right_front, 0x02 | p2os::kWheelStalled);
}

TEST_F(P2osDeviceTest, ThePressedEmergencyStopSwitchesTheMotorsOffUntilTheyAreSwitchedOnAgain) {
  bench.connect();
  order(CommandId::kVel, 300);
  bench.pass(kTenth);
  bench.device.set_faults({.e_stop_pressed = true});
  order(CommandId::kEnable, 1);
  const p2os::Sip sip = bench.information();
  EXPECT_NE(sip.flags & p2os::flag::kEStop, 0);
  EXPECT_EQ(sip.flags & p2os::flag::kMotorsOn, 0);
  EXPECT_EQ(bench.commanded, Twist2{});
  bench.device.set_faults({});
  bench.pass(kTenth);
  EXPECT_FALSE(bench.device.motors_on());
  order(CommandId::kEnable, 1);
  EXPECT_TRUE(bench.device.motors_on());
}

TEST_F(P2osDeviceTest, ThePluggedChargerAndALowBatteryShow) {
  bench.connect();
  bench.device.set_faults({.charger_plugged = true, .battery_v = 11.2});
  const p2os::Sip sip = bench.information();
  EXPECT_NE(sip.flags & p2os::flag::kChargerPower, 0);
  EXPECT_EQ(sip.charge_state, static_cast<std::uint8_t>(p2os::ChargeState::kBulk));
  EXPECT_EQ(sip.battery_x10, 112);
}

TEST_F(P2osDeviceTest, EncoderPacketsComeOnceOrWithEachInformation) {
  bench.connect();
  bench.reading.odom_T_base = {0.05, 0.0, 0.0};
  order(CommandId::kEncoder, 1);
  bench.pass(2 * kTenth);
  const auto once = bench.heard();
  ASSERT_EQ(once.size(), 3U);
  ASSERT_TRUE(once[1].is(PacketId::kEncoder));
  p2os::FieldReader in(once[1].data);
  EXPECT_EQ(in.u32(), 50U * 138U);
  EXPECT_EQ(in.u32(), 50U * 138U);
  order(CommandId::kEncoder, 2);
  bench.pass(2 * kTenth);
  EXPECT_EQ(bench.heard().size(), 4U);
  order(CommandId::kEncoder, 0);
  bench.pass(2 * kTenth);
  EXPECT_EQ(bench.heard().size(), 2U);
}

TEST_F(P2osDeviceTest, GyroscopePacketsHoldFourReadingsThatFallWithRotationCounterClockwise) {
  P2osDeviceParams params;
  params.has_gyro = true;
  P2osBench turning(params);
  turning.connect();
  turning.say(p2os::encode_command(CommandId::kGyro, 1));
  turning.say(p2os::encode_command(CommandId::kSetRa, 3000));
  turning.say(p2os::encode_command(CommandId::kRotVel, 50));
  turning.pass(5 * kTenth);
  const auto packets = turning.heard();
  ASSERT_EQ(packets.size(), 10U);
  const auto readings = p2os::read_gyro(packets[9]);
  ASSERT_TRUE(readings);
  EXPECT_EQ(readings->size(), 4U);
  for (const auto& reading : *readings) {
    EXPECT_NEAR((512.0 - reading.rate) * p2os::gyro_rad_s_per_count(1.626), deg_to_rad(50.0), deg_to_rad(1.0));
  }
}

}  // namespace
}  // namespace seeker::emulator
