#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "server/protocols/p2os/config_packet.hpp"
#include "server/protocols/p2os/field_reader.hpp"
#include "server/protocols/p2os/gyro_packet.hpp"
#include "server/protocols/p2os/identity.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/emulator/devices/p2os_bench.hpp"
#include "tests/unit/server/protocols/p2os/hex.hpp"

namespace seeker::emulator {
namespace {

using p2os::CommandId;
using p2os::hex;
using p2os::PacketId;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Duration kTenth = std::chrono::milliseconds(100);

class P2osDeviceTest : public ::testing::Test {
 protected:
  void order(CommandId id) { bench.say(p2os::encode_command(id)); }
  void order(CommandId id, int argument) { bench.say(p2os::encode_command(id, argument)); }
  /// Lets time pass with PULSE, as a client does.
  void work(double for_s) {
    for (double s = 0.0; s < for_s; s += 0.5) {
      order(CommandId::kPulse);
      bench.pass(std::min(seconds(0.5), seconds(for_s - s)));
    }
  }

  P2osBench bench;
};

TEST_F(P2osDeviceTest, TheHandshakeEchoesAndThenNamesTheBase) {
  bench.say(hex("FA FB 03 00 00 00"));
  EXPECT_EQ(bench.device.take_output(), hex("FA FB 03 00 00 00"));
  bench.say(hex("FA FB 03 01 00 01"));
  EXPECT_EQ(bench.device.take_output(), hex("FA FB 03 01 00 01"));
  bench.say(hex("FA FB 03 02 00 02"));
  const auto names = bench.heard();
  ASSERT_EQ(names.size(), 1U);
  EXPECT_EQ(*p2os::read_identity(names[0]), (p2os::Identity{"Seeker", "Pioneer", "p3dx-sh"}));
  EXPECT_FALSE(bench.device.connected());
  bench.pass(std::chrono::seconds(1));
  EXPECT_THAT(bench.heard(), IsEmpty());
  bench.say(hex("FA FB 03 01 00 01"));
  EXPECT_TRUE(bench.device.connected());
}

TEST_F(P2osDeviceTest, InformationComesEveryTenthOfASecondWithTheMotorsOff) {
  bench.connect(false);
  bench.pass(std::chrono::seconds(1));
  const auto packets = bench.heard();
  ASSERT_EQ(packets.size(), 10U);
  const auto sip = p2os::read_sip(packets[0]);
  EXPECT_EQ(sip->flags & p2os::flag::kMotorsOn, 0);
  EXPECT_EQ(sip->battery_dv, 126);
  EXPECT_EQ(sip->battery_x10, 126);
  order(CommandId::kVel, 250);
  bench.pass(std::chrono::seconds(1));
  EXPECT_EQ(bench.commanded, Twist2{});
}

TEST_F(P2osDeviceTest, AStepOutOfTurnBeginsTheHandshakeAgain) {
  bench.say(hex("FA FB 03 01 00 01"));
  EXPECT_THAT(bench.heard(), IsEmpty());
  bench.say(hex("FA FB 03 00 00 00"));
  bench.say(hex("FA FB 03 02 00 02"));
  EXPECT_EQ(bench.heard().size(), 1U);
  bench.say(hex("FA FB 03 01 00 01"));
  EXPECT_THAT(bench.heard(), IsEmpty());
  bench.connect();
  EXPECT_TRUE(bench.device.connected());
}

TEST_F(P2osDeviceTest, InAConnectionTheNumbersOfTheHandshakeArePulseOpenAndClose) {
  bench.connect();
  bench.say(hex("FA FB 03 00 00 00 FA FB 03 01 00 01"));
  EXPECT_THAT(bench.heard(), IsEmpty());
  EXPECT_TRUE(bench.device.connected());
  bench.say(hex("FA FB 03 02 00 02"));
  EXPECT_FALSE(bench.device.connected());
}

/// What AriaCoda sends to connect, byte by byte (protocols 1.1, 1.3).
TEST_F(P2osDeviceTest, TheSequenceOfAriaConnects) {
  for (const std::uint8_t byte :
       hex("57 4D 53 32 0D FA FB 03 00 00 00 FA FB 03 01 00 01 FA FB 03 02 00 02 FA FB 06 01 3B 01 00 02 3B "
           "FA FB 03 00 00 00 FA FB 06 12 3B 01 00 13 3B FA FB 06 06 3B EE 02 F4 3B FA FB 06 0A 3B 64 00 6E 3B "
           "FA FB 06 04 3B 01 00 05 3B")) {
    bench.say({byte});
  }
  const auto packets = bench.heard();
  ASSERT_EQ(packets.size(), 4U);
  EXPECT_TRUE(packets[3].is(PacketId::kConfig));
  EXPECT_TRUE(bench.device.motors_on());
  bench.say(hex("FA FB 06 02 3B 01 00 03 3B"));
  EXPECT_FALSE(bench.device.connected());
}

/// What Player sends to connect, with its odd SETO (protocols 1.3).
TEST_F(P2osDeviceTest, TheSequenceOfPlayerConnects) {
  bench.reading.odom_T_base = {1.0, 2.0, 0.5};
  for (const std::uint8_t byte : hex("FA FB 03 00 00 00 FA FB 03 01 00 01 FA FB 03 02 00 02 FA FB 03 01 00 01 "
                                     "FA FB 03 00 00 00 FA FB 06 1C 3B 01 00 1D 3B FA FB 06 04 3B 01 00 05 3B "
                                     "FA FB 04 07 3B 07 3B")) {
    bench.say({byte});
    bench.pass(P2osBench::kStep);
  }
  EXPECT_TRUE(bench.device.motors_on());
  const p2os::Sip sip = bench.information();
  EXPECT_EQ(sip.x, 0);
  EXPECT_EQ(sip.y, 0);
  EXPECT_EQ(sip.theta, 0);
}

TEST_F(P2osDeviceTest, AnOldConnectionIsClosedByAClientThatDidNotOpenIt) {
  bench.connect();
  bench.pass(kTenth);
  bench.heard();
  bench.say(hex("FA FB 03 00 00 00"));
  bench.pass(kTenth);
  EXPECT_TRUE(p2os::is_sip(bench.heard().at(0)));
  order(CommandId::kClose);
  bench.connect();
  bench.pass(kTenth);
  EXPECT_EQ(bench.heard().size(), 1U);
}

TEST_F(P2osDeviceTest, VelocitiesCombineAndAreReachedWithTheAcceleration) {
  bench.connect();
  order(CommandId::kVel, 300);
  order(CommandId::kRotVel, -20);
  bench.pass(std::chrono::milliseconds(500));
  EXPECT_NEAR(bench.commanded.v_m_s, 0.15, 0.01);
  bench.pass(std::chrono::seconds(1));
  EXPECT_NEAR(bench.commanded.v_m_s, 0.3, 1e-9);
  EXPECT_NEAR(bench.commanded.omega_rad_s, deg_to_rad(-20.0), 1e-9);
  const p2os::Sip sip = bench.information();
  EXPECT_TRUE(sip.moving);
  EXPECT_EQ(sip.left_velocity, 362);  // 300 + rad(20) / 5.6 m
  EXPECT_EQ(sip.right_velocity, 238);
  EXPECT_EQ(sip.rotational_velocity, -200);
}

TEST_F(P2osDeviceTest, VelocitiesAreClampedToTheSetLimits) {
  bench.connect();
  order(CommandId::kSetV, 200);
  order(CommandId::kSetRv, 30);
  order(CommandId::kSetA, 2000);
  order(CommandId::kSetA, -500);
  order(CommandId::kSetRa, 1000);
  order(CommandId::kVel, 900);
  order(CommandId::kRotVel, 90);
  bench.pass(std::chrono::milliseconds(200));
  EXPECT_NEAR(bench.commanded.v_m_s, 0.2, 1e-9);
  EXPECT_NEAR(bench.commanded.omega_rad_s, deg_to_rad(30.0), 1e-9);
  order(CommandId::kVel, 0);
  bench.pass(std::chrono::milliseconds(200));
  EXPECT_NEAR(bench.commanded.v_m_s, 0.1, 0.011);
  order(CommandId::kClose);
  bench.connect();
  order(CommandId::kVel, 900);
  work(4.0);
  EXPECT_NEAR(bench.commanded.v_m_s, P2osDeviceParams{}.limits.v_max_m_s, 1e-9);
}

TEST_F(P2osDeviceTest, BothWheelsAreCommandedTheRightOneInTheLowByte) {
  bench.connect();
  order(CommandId::kVel2, p2os::vel2_argument({-5, 5}));
  bench.pass(std::chrono::seconds(1));
  EXPECT_NEAR(bench.commanded.v_m_s, 0.0, 1e-9);
  EXPECT_NEAR(bench.commanded.omega_rad_s, 0.56, 1e-9);
  // ARIA's form of left 5, right -5: the word is positive, its low byte is not.
  order(CommandId::kVel2, p2os::vel2_argument({5, -5}));
  bench.pass(std::chrono::seconds(1));
  EXPECT_NEAR(bench.commanded.omega_rad_s, -0.56, 1e-9);
  order(CommandId::kVel, 100);
  bench.pass(std::chrono::seconds(1));
  EXPECT_NEAR(bench.commanded.v_m_s, 0.1, 1e-9);
  EXPECT_NEAR(bench.commanded.omega_rad_s, 0.0, 1e-9);
}

TEST_F(P2osDeviceTest, AMoveEndsAfterItsDistance) {
  bench.connect();
  order(CommandId::kMove, -400);
  work(6.0);
  EXPECT_NEAR(bench.reading.odom_T_base.x_m, -0.4, 0.01);
  EXPECT_EQ(bench.commanded, Twist2{});
}

TEST_F(P2osDeviceTest, ATurnEndsAtItsHeadingTheShorterWayRound) {
  bench.connect();
  order(CommandId::kHead, 170);
  work(6.0);
  EXPECT_NEAR(bench.reading.odom_T_base.theta_rad, deg_to_rad(170.0), deg_to_rad(1.0));
  order(CommandId::kDeltaHead, 40);
  work(6.0);
  EXPECT_NEAR(bench.reading.odom_T_base.theta_rad, deg_to_rad(-150.0), deg_to_rad(1.5));
  order(CommandId::kRotate, 20);
  work(1.0);
  EXPECT_NEAR(bench.commanded.omega_rad_s, deg_to_rad(20.0), 1e-9);
}

TEST_F(P2osDeviceTest, AStopBrakesAndAnEmergencyStopDoesNot) {
  bench.connect();
  order(CommandId::kVel, 300);
  work(1.5);
  order(CommandId::kStop);
  bench.pass(std::chrono::milliseconds(200));
  EXPECT_NEAR(bench.commanded.v_m_s, 0.24, 0.011);
  order(CommandId::kEStop);
  bench.pass(std::chrono::milliseconds(20));
  EXPECT_EQ(bench.commanded, Twist2{});
  EXPECT_TRUE(bench.device.motors_on());
}

TEST_F(P2osDeviceTest, TheWatchdogHaltsTheBaseAndItGoesOnWhenAPacketComes) {
  bench.connect();
  order(CommandId::kSetA, 3000);
  order(CommandId::kSetA, -3000);
  order(CommandId::kVel, 300);
  bench.pass(std::chrono::milliseconds(1980));
  EXPECT_NEAR(bench.commanded.v_m_s, 0.3, 1e-9);
  bench.pass(std::chrono::milliseconds(150));
  EXPECT_EQ(bench.commanded, Twist2{});
  bench.pass(std::chrono::seconds(10));
  EXPECT_EQ(bench.commanded, Twist2{});
  EXPECT_TRUE(bench.device.connected());
  order(CommandId::kPulse);
  bench.pass(std::chrono::milliseconds(150));
  EXPECT_NEAR(bench.commanded.v_m_s, 0.3, 1e-9);
}

TEST_F(P2osDeviceTest, DamagedPacketsDoNotFeedTheWatchdog) {
  bench.connect();
  order(CommandId::kVel, 300);
  for (int k = 0; k < 25; ++k) {
    bench.say(hex("FA FB 03 00 00 01"));
    bench.pass(kTenth);
  }
  EXPECT_TRUE(bench.device.watchdog_holds(bench.now));
}

TEST_F(P2osDeviceTest, NoStepBetweenTwoPacketsIsTakenForDamage) {
  bench.connect();
  bench.information();
  bench.reading.odom_T_base = {0.0, -1.0, 0.0};  // the world put the robot somewhere else
  int y = 0;
  for (int k = 0; k < 20; ++k) {
    const int next = bench.information().y;
    const int step = (next - y) & 0x7FFF;
    EXPECT_LE(std::min(step, 0x8000 - step), 100);
    y = next;
  }
  EXPECT_EQ(y, 0x8000 - 1000);
}

TEST_F(P2osDeviceTest, TheOldBoardCountsInItsOwnUnit) {
  P2osDeviceParams params;
  params.subclass = "p3dx";
  P2osBench old(params);
  old.connect();
  old.reading.odom_T_base = {0.0485, 0.0, deg_to_rad(90.0)};
  const p2os::Sip sip = old.information();
  EXPECT_EQ(sip.x, 100);
  EXPECT_EQ(sip.theta, 1024);
}

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

TEST_F(P2osDeviceTest, TheRateOfTheLineChangesOnCommandAndGoesBackWithTheConnection) {
  bench.connect();
  EXPECT_EQ(bench.device.baud(), 9600U);
  order(CommandId::kHostBaud, 2);
  EXPECT_EQ(bench.device.baud(), 38400U);
  order(CommandId::kHostBaud, 9);
  EXPECT_EQ(bench.device.baud(), 38400U);
  order(CommandId::kClose);
  EXPECT_EQ(bench.device.baud(), 9600U);
}

TEST_F(P2osDeviceTest, PowerThatWasCutLeavesABaseWithoutConnectionAndMotion) {
  bench.connect();
  order(CommandId::kVel, 300);
  bench.pass(kTenth);
  bench.device.power_cycle(bench.now);
  EXPECT_EQ(bench.commanded, Twist2{});
  EXPECT_FALSE(bench.device.connected());
  bench.pass(kTenth);
  EXPECT_THAT(bench.heard(), IsEmpty());
  bench.connect();
  EXPECT_EQ(bench.information().x, 0);
}

TEST_F(P2osDeviceTest, UnknownCommandsAreIgnoredAndOutputThatNobodyTakesIsBounded) {
  bench.connect();
  for (int number = 59; number < 256; ++number) {
    bench.say(p2os::encode_command(p2os::Command{static_cast<std::uint8_t>(number), 1}));
  }
  EXPECT_TRUE(bench.device.connected());
  for (int k = 0; k < 400; ++k) {
    bench.pass(kTenth);
  }
  EXPECT_LT(bench.device.take_output().size(), 5000U);
}

TEST(P2osDeviceParams, PropertiesThatNoBaseHasAreRefused) {
  EXPECT_TRUE(validate(P2osDeviceParams{}));
  EXPECT_FALSE(validate({.subclass = "p2"}));
  EXPECT_FALSE(validate({.baud = 4800}));
  EXPECT_FALSE(validate({.name = std::string(50, 'x')}));
  EXPECT_FALSE(validate({.v_top_m_s = 1.0}));
  EXPECT_FALSE(validate({.sonars_per_sip = 40}));
  EXPECT_FALSE(validate({.sip_period = Duration{0}}));
  EXPECT_TRUE(validate({.baud = 0}));
}

}  // namespace
}  // namespace seeker::emulator
