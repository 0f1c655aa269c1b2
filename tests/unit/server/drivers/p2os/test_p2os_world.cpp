#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/sim/robot_in_world.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/drivers/p2os/p2os_loop.hpp"
#include "tests/unit/server/sim/worlds.hpp"

namespace seeker::drivers {
namespace {

using seeker::testing::Pose2Near;
using std::chrono::seconds;
using ::testing::HasSubstr;

/// The emulated base carries the simulated robot, with its inertia and errors, in a square room.
class P2osWorldTest : public ::testing::Test {
 protected:
  P2osWorldTest() {
    loop.bench.world = [this] {
      robot.command(loop.bench.commanded);
      robot.step(emulator::P2osBench::kStep);
      loop.bench.reading = robot.odometry(loop.bench.now);
      loop.bench.sonar = robot.sonar(loop.bench.now);
    };
    loop.session.set_motors(true, loop.bench.now);
  }

  static constexpr double kSide_m = 6.0;
  sim::World room = sim::testing::square_room(kSide_m);
  sim::RobotInWorld robot{room, sim::RobotModel{}, 1, Pose2{}, 0};
  P2osLoop loop;
};

TEST_F(P2osWorldTest, OdometryAndSonarsAreThoseOfTheSimulatedRobot) {
  ASSERT_TRUE(loop.connect());
  loop.pass(seconds(1));
  loop.drive({0.3, 0.4}, seconds(5));
  loop.drive({}, seconds(2));
  EXPECT_THAT(loop.newest.odom_T_base, Pose2Near(loop.bench.reading.odom_T_base, 0.003, 0.003));
  EXPECT_GT(loop.newest.odom_T_base.translation().norm(), 0.5);
  EXPECT_EQ(loop.session.dropped_steps(), 0U);
  EXPECT_NEAR(loop.newest.battery_v.value(), loop.bench.reading.battery_v, 0.06);
  ASSERT_TRUE(loop.sonar);
  ASSERT_EQ(loop.sonar->readings.size(), robot.model().sonar.base_T_sonar.size());
  for (std::size_t k = 0; k < loop.sonar->readings.size(); ++k) {
    EXPECT_THAT(loop.sonar->readings[k].base_T_sonar, Pose2Near(robot.model().sonar.base_T_sonar[k], 1e-9, 1e-9));
  }
}

TEST_F(P2osWorldTest, AWallHaltsTheBaseWhichBacksOffAndDrivesOn) {
  ASSERT_TRUE(loop.connect());
  loop.pass(seconds(1));
  loop.drive({0.4, 0.0}, seconds(12));
  EXPECT_EQ(robot.truth().contacts, 1);
  EXPECT_NEAR(robot.truth().world_T_base.x_m, kSide_m / 2.0 - robot.model().radius_m, 0.02);
  EXPECT_EQ(loop.bench.commanded, Twist2{});
  EXPECT_TRUE(loop.newest.bumped);
  ASSERT_TRUE(loop.session.base_fault());
  EXPECT_THAT(loop.session.base_fault()->message, HasSubstr("in front"));
  loop.drive({-0.2, 0.0}, seconds(4));
  EXPECT_LT(robot.truth().world_T_base.x_m, kSide_m / 2.0 - robot.model().radius_m - 0.2);
  EXPECT_FALSE(loop.session.base_fault());
  loop.drive({0.2, 0.0}, seconds(1));
  EXPECT_GT(loop.bench.commanded.v_m_s, 0.05);
}

TEST_F(P2osWorldTest, AWallAtTheRearIsLeftForwards) {
  ASSERT_TRUE(loop.connect());
  loop.pass(seconds(1));
  loop.drive({-0.4, 0.0}, seconds(12));
  EXPECT_EQ(loop.bench.commanded, Twist2{});
  ASSERT_TRUE(loop.session.base_fault());
  EXPECT_THAT(loop.session.base_fault()->message, HasSubstr("rear"));
  loop.drive({0.2, 0.0}, seconds(4));
  EXPECT_GT(robot.truth().world_T_base.x_m, -kSide_m / 2.0 + robot.model().radius_m + 0.2);
  EXPECT_FALSE(loop.session.base_fault());
}

TEST_F(P2osWorldTest, ABaseThatDroveOnUnheardIsLookedForHalfwayAlongItsArc) {
  ASSERT_TRUE(loop.connect());
  loop.pass(seconds(1));
  loop.drive({0.35, 0.3}, seconds(3));
  loop.cut = true;
  const Pose2 cut_at = loop.bench.reading.odom_T_base;
  loop.pass(seconds(4));
  loop.wanted = {};
  loop.cut = false;
  ASSERT_TRUE(loop.connect());
  loop.pass(seconds(1));
  const Pose2 unseen = inverse(cut_at) * loop.bench.reading.odom_T_base;
  const Pose2 error = inverse(loop.bench.reading.odom_T_base) * loop.newest.odom_T_base;
  EXPECT_GT(unseen.translation().norm(), 0.7) << "two seconds and its braking";
  EXPECT_LT(error.translation().norm(), 0.55 * unseen.translation().norm());
  EXPECT_LT(std::abs(error.theta_rad), 0.6 * unseen.theta_rad);
}

}  // namespace
}  // namespace seeker::drivers
