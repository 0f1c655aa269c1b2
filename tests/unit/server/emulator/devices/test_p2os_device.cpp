#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/angle.hpp"
#include "server/protocols/p2os/identity.hpp"
#include "tests/unit/server/emulator/devices/p2os_device_fixture.hpp"
#include "tests/unit/server/protocols/p2os/hex.hpp"

namespace seeker::emulator {
namespace {

using p2os::CommandId;
using p2os::hex;
using p2os::PacketId;
using ::testing::IsEmpty;

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

RC_GTEST_PROP(P2osDevice, AnyBytesInAConnectionLeaveABaseThatCanBeCommanded, (const std::vector<std::uint8_t>& bytes)) {
  P2osBench bench;
  bench.connect();
  for (std::size_t k = 0; k + 2 < bytes.size(); k += 3) {
    const auto argument = *rc::gen::inRange(-p2os::kMaxArgument, p2os::kMaxArgument + 1);
    bench.say(p2os::encode_command(p2os::Command{bytes[k], argument}));
    bench.say({bytes[k + 1], bytes[k + 2]});
    bench.pass(kTenth);
    RC_ASSERT(std::abs(bench.commanded.v_m_s) <= P2osDeviceParams{}.v_top_m_s);
    RC_ASSERT(std::abs(bench.commanded.omega_rad_s) <= P2osDeviceParams{}.omega_top_rad_s);
  }
  bench.pass(std::chrono::seconds(1));
  bench.say(p2os::encode_command(CommandId::kClose, 1));
  bench.connect();
  RC_ASSERT(bench.device.connected());
  RC_ASSERT(bench.device.motors_on());
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
