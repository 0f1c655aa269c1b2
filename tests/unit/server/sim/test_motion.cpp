#include <gtest/gtest.h>
// gtest first: rapidcheck relies on it.
#include <rapidcheck/gtest.h>

#include "tests/support/matchers.hpp"
#include "tests/unit/server/sim/worlds.hpp"

namespace seeker::sim {
namespace {

using namespace std::chrono_literals;
using testing::make;
using testing::square_room;

TEST(Motion, KeepsTheLimitsOfTheBase) {
  const RobotModel model = without_errors(RobotModel{});
  Simulation simulation = make(square_room(20.0), model);
  simulation.command({5.0, -9.0});
  Twist2 before;
  for (int i = 0; i < 300; ++i) {
    simulation.advance(10ms);
    const Twist2 now = simulation.truth().velocity;
    EXPECT_LE(std::abs(now.v_m_s - before.v_m_s), model.acceleration_m_s2 * 0.01 + 1e-12);
    EXPECT_LE(std::abs(now.omega_rad_s - before.omega_rad_s), model.angular_acceleration_rad_s2 * 0.01 + 1e-12);
    before = now;
  }
  EXPECT_DOUBLE_EQ(before.v_m_s, model.v_max_m_s);
  EXPECT_DOUBLE_EQ(before.omega_rad_s, -model.omega_max_rad_s);
}

TEST(Motion, DrivesTheWayThatAccelerationAllows) {
  Simulation simulation = make(square_room(20.0), without_errors(RobotModel{}));
  simulation.command({0.3, 0.0});
  simulation.advance(5s);
  // One second of acceleration (0.15 m), four of 0.3 m/s.
  EXPECT_NEAR(simulation.truth().world_T_base.x_m, 0.15 + 1.2, 1e-9);
  EXPECT_NEAR(simulation.truth().path_length_m, 1.35, 1e-9);
  EXPECT_EQ(simulation.now(), robot_time_s(5.0));
}

TEST(Motion, PerfectEncodersFollowTheTruth) {
  Simulation simulation = make(square_room(20.0), without_errors(RobotModel{}));
  simulation.command({0.4, 0.5});
  simulation.advance(7s);
  EXPECT_THAT(simulation.odometry().odom_T_base,
              seeker::testing::Pose2Near(simulation.truth().world_T_base, 1e-9, 1e-9));
}

/// Error of the encoders after driving and after turning, over many seeds.
struct Spread {
  double mean = 0.0;
  double sigma = 0.0;
};
template <class F>
Spread spread(int runs, F&& value) {
  double sum = 0.0;
  double sum2 = 0.0;
  for (int i = 0; i < runs; ++i) {
    const double x = value(static_cast<std::uint64_t>(i + 1));
    sum += x;
    sum2 += x * x;
  }
  const double mean = sum / runs;
  return {mean, std::sqrt(sum2 / runs - mean * mean)};
}

TEST(Odometry, NoiseHasTheSpreadOfItsParameters) {
  RobotModel model = without_errors(RobotModel{});
  model.odometry.sigma_distance = 0.02;
  model.odometry.sigma_rotation = 0.03;
  constexpr int kRuns = 400;
  const Spread way = spread(kRuns, [&](std::uint64_t seed) {
    Simulation s = make(square_room(20.0), model, seed);
    s.command({0.5, 0.0});
    s.advance(8s);
    return s.odometry().odom_T_base.x_m - s.truth().world_T_base.x_m;
  });
  const double driven_m = 0.5 * 8.0 - 0.5 * 0.5 / 0.3 / 2.0;
  EXPECT_NEAR(way.mean, 0.0, 4.0 * way.sigma / std::sqrt(kRuns));
  EXPECT_NEAR(way.sigma, 0.02 * std::sqrt(driven_m), 0.15 * 0.02 * std::sqrt(driven_m));
  const Spread turn = spread(kRuns, [&](std::uint64_t seed) {
    Simulation s = make(square_room(20.0), model, seed);
    s.command({0.0, 0.5});
    s.advance(4s);
    return wrap_angle(s.odometry().odom_T_base.theta_rad - s.truth().world_T_base.theta_rad);
  });
  const double turned_rad = 0.5 * 4.0 - 0.5 * 0.5 / deg_to_rad(100.0) / 2.0;
  EXPECT_NEAR(turn.sigma, 0.03 * std::sqrt(turned_rad), 0.15 * 0.03 * std::sqrt(turned_rad));
}

TEST(Odometry, UnequalWheelsBendTheWay) {
  RobotModel model = without_errors(RobotModel{});
  model.odometry.left_wheel_scale = 0.99;
  model.odometry.right_wheel_scale = 1.01;
  Simulation s = make(square_room(20.0), model);
  s.command({0.5, 0.0});
  s.advance(6s);
  const double driven_m = s.truth().path_length_m;
  EXPECT_NEAR(s.odometry().odom_T_base.theta_rad, 0.02 * driven_m / model.wheel_base_m, 1e-9);
}

TEST(Contact, AWallStopsTheRobotAndIsCountedOnce) {
  Simulation s = make(square_room(4.0), without_errors(RobotModel{}));
  s.command({0.5, 0.0});
  s.advance(10s);
  EXPECT_EQ(s.truth().contacts, 1);
  EXPECT_TRUE(s.odometry().stalled);
  EXPECT_TRUE(s.odometry().bumped);
  EXPECT_NEAR(s.truth().world_T_base.x_m, 2.0 - 0.26, 0.01);
  EXPECT_EQ(s.truth().min_clearance_m, 0.0);
  s.command({-0.5, 0.0});
  s.advance(2s);
  EXPECT_FALSE(s.odometry().stalled);
  EXPECT_FALSE(s.odometry().bumped);
  s.command({0.5, 0.0});
  s.advance(8s);
  EXPECT_EQ(s.truth().contacts, 2);
}

TEST(Contact, FurnitureStopsTheRobotByItsHeight) {
  World world = square_room(6.0);
  world.boxes.push_back({Pose2{1.5, 0.0, 0.3}, 0.5, 2.0, 0.7, 0.8, {}});  // a table's top: the robot fits under it
  Simulation under = make(world, without_errors(RobotModel{}));
  under.command({0.5, 0.0});
  under.advance(5s);
  EXPECT_EQ(under.truth().contacts, 0);
  world.boxes[0].z_min_m = 0.1;
  Simulation against = make(world, without_errors(RobotModel{}));
  against.command({0.5, 0.0});
  against.advance(5s);
  EXPECT_EQ(against.truth().contacts, 1);
}

RC_GTEST_PROP(Contact, RandomCommandsNeverLeaveTheRoom, ()) {
  World world = square_room(3.0);
  world.boxes.push_back({Pose2{0.9, 0.6, 0.7}, 0.5, 0.3, 0.0, 1.0, {}});
  Wall screen;  // thin as paper
  screen.a = {-1.0, -1.5};
  screen.b = {-1.0, 1.5};
  world.walls.push_back(screen);
  Simulation s = make(world, RobotModel{}, *rc::gen::arbitrary<std::uint64_t>());
  const int commands = *rc::gen::inRange(5, 30);
  for (int i = 0; i < commands; ++i) {
    s.command({*rc::gen::inRange(-20, 21) * 0.1, *rc::gen::inRange(-20, 21) * 0.1});
    s.advance(std::chrono::milliseconds(*rc::gen::inRange(1, 1500)));
    const Pose2 pose = s.truth().world_T_base;
    // The body, but for one step of 10 ms, stays on its side of the screen and inside the walls.
    RC_ASSERT(pose.x_m >= -1.0 + 0.25);
    RC_ASSERT(std::max(pose.x_m, std::abs(pose.y_m)) <= 1.5 - 0.25);
  }
}

TEST(Contact, AStartWithoutRoomIsRefused) {
  World world = square_room(4.0);
  world.starts = {Pose2{1.9, 0.0, 0.0}};
  EXPECT_FALSE(Simulation::create(world, RobotModel{}, 1));
  world.starts = {Pose2{}};
  world.boxes.push_back({Pose2{}, 2.0, 2.0, 0.0, 1.0, {}});  // the start is inside
  EXPECT_FALSE(Simulation::create(world, RobotModel{}, 1));
  EXPECT_FALSE(Simulation::create(square_room(4.0), RobotModel{}, 1, 7));
}

TEST(People, WalkToAndFroAndWaitForTheRobot) {
  World world = square_room(8.0);
  world.people.push_back({{{-3.0, 2.0}, {3.0, 2.0}}});
  world.people.push_back({{{-3.0, 0.0}, {3.0, 0.0}}});
  world.people_walk = true;
  Simulation s = make(world, without_errors(RobotModel{}));
  s.advance(30s);
  EXPECT_EQ(s.truth().contacts, 0);
  // The second person waits in front of the robot: 0.6 m to its edge.
  const LaserScan scan = s.scan();
  EXPECT_GT(*std::min_element(scan.ranges_m.begin(), scan.ranges_m.end()), 0.5F);
  s.command({-0.3, 0.0});
  s.advance(10s);
  EXPECT_EQ(s.truth().contacts, 1);
}

}  // namespace
}  // namespace seeker::sim
