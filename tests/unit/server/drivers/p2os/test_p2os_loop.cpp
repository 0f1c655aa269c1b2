#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/drivers/p2os/p2os_loop.hpp"

namespace seeker::drivers {
namespace {

using seeker::testing::Pose2Near;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

/// Drives an arc, a turn and a way back, and stands.
void drive_around(P2osLoop& loop) {
  loop.drive({0.4, 0.3}, seconds(6));
  loop.drive({0.0, -0.8}, seconds(3));
  loop.drive({-0.2, 0.1}, seconds(4));
  loop.drive({}, seconds(2));
}

class P2osLoopOfModel : public ::testing::TestWithParam<const char*> {};

TEST_P(P2osLoopOfModel, TheOdometryIsThatOfTheBase) {
  emulator::P2osDeviceParams device;
  device.subclass = GetParam();
  P2osLoop loop({}, device);
  loop.session.set_motors(true, loop.bench.now);
  ASSERT_TRUE(loop.connect());
  loop.pass(seconds(1));
  EXPECT_TRUE(loop.newest.motors_enabled);
  drive_around(loop);
  EXPECT_GT(loop.bench.reading.odom_T_base.translation().norm(), 0.5);
  EXPECT_THAT(loop.newest.odom_T_base, Pose2Near(loop.bench.reading.odom_T_base, 0.003, 0.003));
  EXPECT_EQ(loop.session.dropped_steps(), 0U);
  EXPECT_EQ(loop.session.statistics().packets_bad, 0U);
  EXPECT_EQ(loop.session.statistics().bytes_skipped, 0U);
}

INSTANTIATE_TEST_SUITE_P(P2osLoop, P2osLoopOfModel, ::testing::Values("p3dx", "p3dx-sh", "p3at", "p3at-sh"));

class P2osLoopTest : public ::testing::Test {
 protected:
  void connect() {
    loop.session.set_motors(true, loop.bench.now);
    ASSERT_TRUE(loop.connect());
    loop.pass(seconds(1));
  }

  P2osLoop loop;
};

TEST_F(P2osLoopTest, BothWheelsCommandedDriveTheSameWay) {
  P2osParams params;
  params.use_vel2 = true;
  P2osLoop wheels(params);
  wheels.session.set_motors(true, wheels.bench.now);
  ASSERT_TRUE(wheels.connect());
  wheels.drive({0.2, 0.56}, seconds(3));
  EXPECT_NEAR(wheels.bench.commanded.v_m_s, 0.2, 1e-9);
  EXPECT_NEAR(wheels.bench.commanded.omega_rad_s, 0.56, 1e-9);
}

TEST_F(P2osLoopTest, BitErrorsCostNoPose) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    P2osLoop noisy({}, {}, seed);
    noisy.session.set_motors(true, noisy.bench.now);
    ASSERT_TRUE(noisy.connect());
    noisy.pass(seconds(1));
    noisy.bit_error = 1e-4;
    for (int k = 0; k < 8; ++k) {
      drive_around(noisy);
    }
    noisy.bit_error = 0.0;
    noisy.pass(seconds(1));
    ASSERT_TRUE(noisy.session.state()) << noisy.session.state().error().message;
    EXPECT_GT(noisy.session.statistics().packets_bad, 10U);
    EXPECT_EQ(noisy.session.statistics().connects, 1U);
    EXPECT_THAT(noisy.newest.odom_T_base, Pose2Near(noisy.bench.reading.odom_T_base, 0.02, 0.02)) << "seed " << seed;
  }
}

TEST_F(P2osLoopTest, TheHandshakeIsCompletedDespiteBitErrors) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    P2osLoop noisy({}, {}, seed);
    noisy.bit_error = 1e-3;
    EXPECT_TRUE(noisy.connect(seconds(60))) << "seed " << seed;
  }
}

TEST_F(P2osLoopTest, ACutLineIsNoticedWithinHalfASecondAndTheBaseComesBackHalfwayToWhereItStands) {
  connect();
  loop.drive({0.3, 0.0}, seconds(3));
  loop.cut = true;
  loop.pass(milliseconds(620));  // of which up to 100 ms are those until the next information
  EXPECT_EQ(loop.session.state().error().code, Errc::kLinkLost);
  const double seen_m = loop.newest.odom_T_base.x_m;
  const double drove_m = loop.bench.reading.odom_T_base.x_m;
  loop.wanted = {};
  loop.pass(seconds(4));
  EXPECT_EQ(loop.bench.commanded, Twist2{}) << "the watchdog holds the base";
  loop.cut = false;
  ASSERT_TRUE(loop.connect());
  loop.pass(seconds(1));
  EXPECT_EQ(loop.session.statistics().connects, 2U);
  constexpr double kUnseen_m = 0.3 * 2.0 + 0.3 * 0.3 / (2.0 * 0.3);  // two seconds, and braking by 0.3 m/s^2
  EXPECT_NEAR(loop.newest.odom_T_base.x_m, seen_m + kUnseen_m / 2.0, 0.06);
  EXPECT_GT(loop.bench.reading.odom_T_base.x_m - drove_m, kUnseen_m / 2.0) << "nobody but the watchdog stopped it";
  EXPECT_TRUE(loop.newest.motors_enabled);
  const double before_m = loop.newest.odom_T_base.x_m;
  const double base_m = loop.bench.reading.odom_T_base.x_m;
  loop.drive({0.3, 0.0}, seconds(3));
  loop.drive({}, seconds(2));
  EXPECT_NEAR(loop.newest.odom_T_base.x_m - before_m, loop.bench.reading.odom_T_base.x_m - base_m, 0.003);
}

TEST_F(P2osLoopTest, NothingThatWasSaidWhileTheLineWasGoneIsSentWhenItIsThereAgain) {
  connect();
  loop.drive({0.3, 0.0}, seconds(1));
  static_cast<void>(loop.session.take_actions());
  loop.session.line_lost();
  for (int tick = 0; tick < 100; ++tick) {
    loop.bench.now += milliseconds(100);
    loop.session.loop_alive(loop.bench.now);
    loop.session.set_velocity({0.3, 0.0}, loop.bench.now);
    loop.session.set_motors(tick % 2 == 0, loop.bench.now);
  }
  EXPECT_TRUE(loop.session.take_actions().empty());
  loop.session.open(loop.bench.now);
  loop.session.pass(loop.bench.now);
  std::vector<std::uint8_t> first;
  for (const LineAction& action : loop.session.take_actions()) {
    if (const auto* write = std::get_if<WriteBytes>(&action); write != nullptr && first.empty()) {
      first = write->bytes;
    }
  }
  EXPECT_EQ(first, p2os::encode_command(p2os::CommandId::kPulse)) << "SYNC0 is written as command 0";
}

TEST_F(P2osLoopTest, ABaseWhosePowerWasCutIsConnectedAnew) {
  connect();
  loop.drive({0.3, 0.2}, seconds(3));
  const Pose2 before = loop.newest.odom_T_base;
  loop.wanted = {};
  loop.bench.device.power_cycle(loop.bench.now);
  loop.pass(seconds(2));
  ASSERT_TRUE(loop.connect());
  loop.pass(seconds(1));
  EXPECT_EQ(loop.bench.commanded, Twist2{});
  // Nothing shows that it did not drive on in the 1.6 s until it was heard again.
  EXPECT_THAT(loop.newest.odom_T_base, Pose2Near(before * integrate(Twist2{0.3, 0.2}, 1.6 / 2.0), 0.06, 0.05));
  EXPECT_TRUE(loop.bench.device.motors_on());
}

TEST_F(P2osLoopTest, ABaseAtAnotherRateIsFound) {
  for (const std::uint32_t baud : {9600U, 19200U, 38400U, 57600U, 115200U}) {
    emulator::P2osDeviceParams device;
    device.baud = baud;
    P2osLoop other({}, device);
    EXPECT_TRUE(other.connect()) << baud;
    EXPECT_EQ(other.host_baud, baud);
  }
}

TEST_F(P2osLoopTest, ABaseThatStillSendsInAnOldConnectionAtAFasterRateIsFound) {
  loop.bench.connect();
  loop.bench.say(p2os::encode_command(p2os::CommandId::kHostBaud, 2));
  EXPECT_TRUE(loop.connect());
  EXPECT_EQ(loop.host_baud, 9600U);
  EXPECT_EQ(loop.session.statistics().connects, 1U);
}

TEST_F(P2osLoopTest, TheRateIsSwitchedAndGoesBackWithTheFarewell) {
  P2osParams params;
  params.switch_to_baud = 38400;
  emulator::P2osDeviceParams device;
  device.baud_may_change = true;
  P2osLoop fast(params, device);
  ASSERT_TRUE(fast.connect());
  EXPECT_EQ(fast.host_baud, 38400U);
  fast.pass(seconds(2));
  EXPECT_TRUE(fast.session.state());
  fast.session.close(fast.bench.now);
  fast.pass(seconds(1));
  EXPECT_FALSE(fast.bench.device.connected());
  EXPECT_EQ(fast.host_baud, 9600U);
  EXPECT_EQ(fast.bench.device.baud(), 9600U);
}

TEST_F(P2osLoopTest, OverTcpThereIsNoRate) {
  P2osParams params;
  params.serial = false;
  emulator::P2osDeviceParams device;
  device.baud = 0;
  P2osLoop tcp(params, device);
  EXPECT_TRUE(tcp.connect(seconds(2)));
  EXPECT_EQ(tcp.host_baud, 0U);
}

TEST_F(P2osLoopTest, AContactHaltsTheBaseThoughTheLoopKeepsCommandingIt) {
  connect();
  loop.drive({0.3, 0.0}, seconds(3));
  loop.bench.reading.bumped = true;
  loop.pass(milliseconds(300));
  loop.pass(seconds(1));
  EXPECT_EQ(loop.bench.commanded, Twist2{});
  EXPECT_TRUE(loop.newest.bumped);
  EXPECT_THAT(loop.session.base_fault()->message, HasSubstr("in front"));
  loop.drive({-0.1, 0.0}, seconds(1));
  EXPECT_NEAR(loop.bench.commanded.v_m_s, -0.1, 1e-9);
  loop.bench.reading.bumped = false;
  loop.drive({0.1, 0.0}, seconds(1));
  EXPECT_NEAR(loop.bench.commanded.v_m_s, 0.1, 1e-9);
}

TEST_F(P2osLoopTest, ABlockedBaseIsHaltedAndReported) {
  connect();
  loop.drive({0.3, 0.0}, seconds(2));
  loop.bench.blocked = true;
  loop.pass(milliseconds(400));
  EXPECT_EQ(loop.bench.commanded, Twist2{});
  EXPECT_THAT(loop.session.base_fault()->message, HasSubstr("blocked"));
  loop.drive({}, seconds(2));
  loop.bench.blocked = false;
  loop.pass(milliseconds(300));
  EXPECT_FALSE(loop.session.base_fault());
}

TEST_F(P2osLoopTest, TheEmergencyStopIsReportedAndTheMotorsComeBackOnCommandOnly) {
  connect();
  loop.drive({0.3, 0.0}, seconds(1));
  loop.bench.device.set_faults({.e_stop_pressed = true});
  loop.pass(milliseconds(300));
  EXPECT_EQ(loop.bench.commanded, Twist2{});
  EXPECT_THAT(loop.session.base_fault()->message, HasSubstr("emergency stop is pressed"));
  loop.bench.device.set_faults({});
  loop.pass(seconds(3));
  EXPECT_EQ(loop.bench.commanded, Twist2{});
  EXPECT_THAT(loop.session.base_fault()->message, HasSubstr("switched off"));
  loop.session.set_motors(true, loop.bench.now);
  loop.pass(seconds(2));
  EXPECT_NEAR(loop.bench.commanded.v_m_s, 0.3, 1e-9);
}

TEST_F(P2osLoopTest, ALoopThatDiesLeavesAStandingBaseThatItsWatchdogHolds) {
  connect();
  loop.drive({0.3, 0.0}, seconds(2));
  loop.loop_runs = false;
  loop.pass(seconds(2));
  EXPECT_EQ(loop.bench.commanded, Twist2{});
  EXPECT_TRUE(loop.session.state());
  loop.pass(seconds(3));
  EXPECT_TRUE(loop.bench.device.watchdog_holds(loop.bench.now));
}

TEST_F(P2osLoopTest, ALivingLoopKeepsTheWatchdogFromHolding) {
  connect();
  for (int k = 0; k < 100; ++k) {
    loop.pass(milliseconds(100));
    ASSERT_FALSE(loop.bench.device.watchdog_holds(loop.bench.now));
  }
}

TEST_F(P2osLoopTest, TheGyroscopeKeepsTheHeading) {
  emulator::P2osDeviceParams device;
  device.has_gyro = true;
  device.gyro_rest_count = 507.3;
  P2osLoop loop_with_gyro({}, device);
  loop_with_gyro.session.set_motors(true, loop_with_gyro.bench.now);
  ASSERT_TRUE(loop_with_gyro.connect());
  loop_with_gyro.pass(seconds(3));
  drive_around(loop_with_gyro);
  EXPECT_THAT(loop_with_gyro.newest.odom_T_base,
              Pose2Near(loop_with_gyro.bench.reading.odom_T_base, 0.05, deg_to_rad(2.0)));
}

TEST_F(P2osLoopTest, TheRingIsCompleteAfterAFewPackets) {
  for (int k = 0; k < 8; ++k) {
    loop.bench.sonar.readings.push_back({Pose2{}, k == 4 ? kNoReturn : 0.5F + static_cast<float>(k)});
  }
  connect();
  ASSERT_TRUE(loop.sonar);
  ASSERT_EQ(loop.sonar->readings.size(), 8U);
  EXPECT_FLOAT_EQ(loop.sonar->readings[3].range_m, 3.5F);
  EXPECT_EQ(loop.sonar->readings[4].range_m, kNoReturn);
  EXPECT_EQ(loop.sonar->readings[5].range_m, kNoReturn);  // 5.5 m are beyond the ring's range
  EXPECT_TRUE(validate(*loop.sonar));
}

TEST_F(P2osLoopTest, TheFarewellLeavesABaseWithItsMotorsOff) {
  connect();
  loop.drive({0.3, 0.0}, seconds(1));
  loop.session.close(loop.bench.now);
  loop.pass(milliseconds(200));
  EXPECT_EQ(loop.bench.commanded, Twist2{});
  EXPECT_FALSE(loop.bench.device.connected());
  EXPECT_FALSE(loop.bench.device.motors_on());
}

}  // namespace
}  // namespace seeker::drivers
