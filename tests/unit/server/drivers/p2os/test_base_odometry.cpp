#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/angle.hpp"
#include "server/drivers/p2os/base_odometry.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::drivers {
namespace {

using seeker::testing::Pose2Near;

/// Odometry of a base whose counters the test sets; 100 ms pass from packet to packet.
class BaseOdometryTest : public ::testing::Test {
 protected:
  void connect(const char* subclass = "p3dx-sh") {
    odometry.connect(*p2os::find_pioneer_model(subclass), std::chrono::milliseconds(100));
    add(0, 0, 0);
  }
  bool add(int x, int y, int theta) {
    now += std::chrono::milliseconds(100);
    sip.x = static_cast<std::uint16_t>(x & 0x7FFF);
    sip.y = static_cast<std::uint16_t>(y & 0x7FFF);
    sip.theta = static_cast<std::int16_t>(theta);
    return odometry.add(sip, now);
  }

  P2osParams params;
  BaseOdometry odometry{params};
  p2os::Sip sip;
  RobotTime now;
};

TEST_F(BaseOdometryTest, TheFirstPacketIsTheZero) {
  odometry.connect(*p2os::find_pioneer_model("p3dx-sh"), std::chrono::milliseconds(100));
  EXPECT_TRUE(add(1234, 4321, 99));
  EXPECT_EQ(odometry.odom_T_base(), Pose2{});
}

TEST_F(BaseOdometryTest, CountersWrapInBothDirections) {
  connect();
  EXPECT_TRUE(add(-40, 30, 0));
  EXPECT_TRUE(add(-80, 60, 0));
  EXPECT_THAT(odometry.odom_T_base(), Pose2Near(Pose2{-0.08, 0.06, 0.0}, 1e-9, 1e-9));
  EXPECT_TRUE(add(20, -10, 0));
  EXPECT_THAT(odometry.odom_T_base(), Pose2Near(Pose2{0.02, -0.01, 0.0}, 1e-9, 1e-9));
}

TEST_F(BaseOdometryTest, TheOldBoardCountsInItsOwnUnit) {
  connect("p3dx");
  add(100, 0, 0);
  EXPECT_THAT(odometry.odom_T_base(), Pose2Near(Pose2{0.0485, 0.0, 0.0}, 1e-9, 1e-9));
}

TEST_F(BaseOdometryTest, TheHeadingWrapsHoweverTheBaseCountsIt) {
  connect();
  add(0, 0, -20);
  EXPECT_NEAR(odometry.odom_T_base().theta_rad, -20 * kTwoPi / 4096, 1e-9);
  add(0, 0, 4096 - 40);
  EXPECT_NEAR(odometry.odom_T_base().theta_rad, -40 * kTwoPi / 4096, 1e-9);
}

TEST_F(BaseOdometryTest, ADamagedPacketCostsNothing) {
  connect();
  add(20, 0, 0);
  EXPECT_FALSE(add(9000, 0, 0));
  EXPECT_EQ(odometry.dropped_steps(), 1U);
  EXPECT_TRUE(add(60, 0, 0));
  EXPECT_THAT(odometry.odom_T_base(), Pose2Near(Pose2{0.06, 0.0, 0.0}, 1e-9, 1e-9));
  EXPECT_EQ(odometry.dropped_steps(), 1U);
}

TEST_F(BaseOdometryTest, CountersThatWereSetAnewGoOnFromThere) {
  connect();
  add(2000 / 10, 0, 0);
  add(400, 0, 0);
  EXPECT_FALSE(add(0, 5000, 0));
  EXPECT_TRUE(add(20, 5000, 0));
  EXPECT_THAT(odometry.odom_T_base(), Pose2Near(Pose2{0.42, 0.0, 0.0}, 1e-9, 1e-9));
}

TEST_F(BaseOdometryTest, AnImpossibleTurnIsDropped) {
  connect();
  EXPECT_FALSE(add(0, 0, 2000));
  EXPECT_TRUE(add(0, 0, 4));
  EXPECT_NEAR(odometry.odom_T_base().theta_rad, 4 * kTwoPi / 4096, 1e-9);
}

TEST_F(BaseOdometryTest, LostPacketsAreMadeUpForByTheNextOne) {
  connect();
  now += std::chrono::milliseconds(300);
  EXPECT_TRUE(add(900, 0, 0));
  EXPECT_THAT(odometry.odom_T_base(), Pose2Near(Pose2{0.9, 0.0, 0.0}, 1e-9, 1e-9));
}

TEST_F(BaseOdometryTest, TheVelocityIsThatOfTheWheels) {
  connect();
  sip.left_velocity = 100;
  sip.right_velocity = 200;
  add(10, 0, 0);
  EXPECT_DOUBLE_EQ(odometry.velocity().v_m_s, 0.15);
  EXPECT_DOUBLE_EQ(odometry.velocity().omega_rad_s, 0.05 * 5.6);
  sip.rotational_velocity = 123;
  add(20, 0, 0);
  EXPECT_DOUBLE_EQ(odometry.velocity().omega_rad_s, deg_to_rad(12.3));
}

/// Readings of 100 ms at this rotation around a value at rest of 510.
std::vector<p2os::GyroReading> readings(double omega_rad_s) {
  const double counts = omega_rad_s / p2os::gyro_rad_s_per_count(1.626);
  return std::vector<p2os::GyroReading>(4, {static_cast<std::uint16_t>(std::lround(510.0 - counts)), 25});
}

TEST_F(BaseOdometryTest, TheGyroscopeTurnsTheHeadingOnceItsValueAtRestIsKnown) {
  connect();
  for (int k = 0; k < 15; ++k) {
    odometry.add(readings(0.0));
    add(0, 0, 0);
  }
  const double count_rad_s = p2os::gyro_rad_s_per_count(1.626);
  sip.left_velocity = -100;
  sip.right_velocity = 100;
  // The wheels slip: they show twice the rotation of the gyroscope.
  const int units = static_cast<int>(std::lround(2.0 * 30.0 * count_rad_s * 0.1 / p2os::kAngleUnit_rad));
  for (int k = 1; k <= 5; ++k) {
    odometry.add(readings(30.0 * count_rad_s));
    add(0, 0, k * units);
  }
  sip.left_velocity = sip.right_velocity = 0;
  odometry.add(readings(0.0));
  add(0, 0, 5 * units);
  EXPECT_NEAR(odometry.odom_T_base().theta_rad, 30.0 * count_rad_s * 0.5, 1e-9);
}

TEST_F(BaseOdometryTest, WithoutReadingsForTheTimeTheWheelsTurnTheHeading) {
  connect();
  for (int k = 0; k < 15; ++k) {
    odometry.add(readings(0.0));
    add(0, 0, 0);
  }
  sip.left_velocity = -100;
  sip.right_velocity = 100;
  add(0, 0, 40);
  EXPECT_NEAR(odometry.odom_T_base().theta_rad, 40 * p2os::kAngleUnit_rad, 1e-9);
}

TEST_F(BaseOdometryTest, BeforeItsValueAtRestIsKnownTheGyroscopeIsNotUsed) {
  connect();
  sip.left_velocity = -100;
  sip.right_velocity = 100;
  odometry.add(readings(1.0));
  add(0, 0, 40);
  EXPECT_NEAR(odometry.odom_T_base().theta_rad, 40 * p2os::kAngleUnit_rad, 1e-9);
}

TEST_F(BaseOdometryTest, ADriftingGyroscopeDoesNotTurnABaseThatStands) {
  connect();
  for (int k = 0; k < 15; ++k) {
    odometry.add(readings(0.0));
    add(0, 0, 0);
  }
  for (int k = 0; k < 50; ++k) {
    odometry.add(readings(0.05));
    add(0, 0, 0);
  }
  EXPECT_DOUBLE_EQ(odometry.odom_T_base().theta_rad, 0.0);
}

RC_GTEST_PROP(BaseOdometry, AnyWayInTheUnitsOfTheCountersIsFollowedToTheUnit, (const std::vector<std::int8_t>& ways)) {
  P2osParams params;
  BaseOdometry odometry(params);
  odometry.connect(*p2os::find_pioneer_model("p3at"), std::chrono::milliseconds(100));
  p2os::Sip sip;
  int x = 30000;
  int y = 0;
  RobotTime now;
  sip.x = 30000;
  odometry.add(sip, now);
  for (const std::int8_t way : ways) {
    x += way;
    y -= way / 2;
    now += std::chrono::milliseconds(100);
    sip.x = static_cast<std::uint16_t>(x & 0x7FFF);
    sip.y = static_cast<std::uint16_t>(y & 0x7FFF);
    RC_ASSERT(odometry.add(sip, now));
  }
  RC_ASSERT(std::abs(odometry.odom_T_base().x_m - (x - 30000) * 0.465e-3) < 1e-9);
  RC_ASSERT(std::abs(odometry.odom_T_base().y_m - y * 0.465e-3) < 1e-9);
}

}  // namespace
}  // namespace seeker::drivers
