#include <gtest/gtest.h>
#include <Eigen/LU>
// gtest first: rapidcheck relies on it.
#include <rapidcheck/gtest.h>

#include "common/core/rng.hpp"
#include "server/sim/range_sensors.hpp"
#include "tests/unit/server/sim/worlds.hpp"

namespace seeker::sim {
namespace {

using testing::make;
using testing::square_room;
using testing::to_wall_m;

RC_GTEST_PROP(Lidar, MeetsTheWallsOfASquareRoomWhereGeometrySays, ()) {
  const double x = *rc::gen::inRange(-250, 251) * 0.01;
  const double y = *rc::gen::inRange(-250, 251) * 0.01;
  const double heading = *rc::gen::inRange(-314, 315) * 0.01;
  const RobotModel model = without_errors(RobotModel{});
  const Scene scene(square_room(6.0));
  const Pose2 pose{x, y, heading};
  Rng rng(1);
  const LaserScan scan = sweep(model.lidar, scene, pose, RobotTime{}, rng);
  RC_ASSERT(scan.ranges_m.size() == 361U);
  const Pose2 laser = pose * model.lidar.base_T_laser;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double expected = to_wall_m(laser.translation(), laser.theta_rad + scan.angle_rad(i), 6.0);
    if (expected < model.lidar.range_max_m) {
      RC_ASSERT(std::abs(scan.ranges_m[i] - expected) < 1e-4);
    }
  }
}

RC_GTEST_PROP(Lidar, GridFindsTheSameFaceAsTryingAll, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  World world = square_room(9.0);
  for (int i = 0; i < 30; ++i) {
    world.boxes.push_back({Pose2{rng.uniform(-4.0, 4.0), rng.uniform(-4.0, 4.0), rng.uniform(-3.0, 3.0)},
                           rng.uniform(0.05, 1.0),
                           rng.uniform(0.05, 1.0),
                           0.0,
                           1.0,
                           {}});
  }
  const Scene scene(world);
  for (int ray = 0; ray < 40; ++ray) {
    const Point2 origin(rng.uniform(-4.4, 4.4), rng.uniform(-4.4, 4.4));
    const double angle = rng.uniform(-kPi, kPi);
    const Point2 direction(std::cos(angle), std::sin(angle));
    double brute_m = 1e9;
    for (const Face& face : scene.faces()) {
      Matrix2 m;
      m << direction, -face.segment.direction;
      const Point2 solution = m.inverse() * (face.segment.a - origin);
      if (solution.x() >= 0.0 && solution.y() >= 0.0 && solution.y() <= face.segment.length_m) {
        brute_m = std::min(brute_m, solution.x());
      }
    }
    const auto hit = scene.nearest(origin, direction, 20.0, 0.3);
    RC_ASSERT(hit.has_value());
    RC_ASSERT(std::abs(hit->distance_m - brute_m) < 1e-9);
  }
}

TEST(Lidar, SignalQualityFallsWithRangeAndIncidence) {
  LidarModel model = without_errors(RobotModel{}).lidar;
  const Scene scene(square_room(6.0));
  Rng rng(1);
  EXPECT_TRUE(sweep(model, scene, {}, RobotTime{}, rng).quality.empty()) << "unless the scanner reports one";
  model.quality_max = 47;
  model.quality_range_m = 1.0;
  const LaserScan near = sweep(model, scene, {2.5, 0.0, 0.0}, RobotTime{}, rng);
  const LaserScan far = sweep(model, scene, {}, RobotTime{}, rng);
  ASSERT_EQ(far.quality.size(), far.ranges_m.size());
  EXPECT_EQ(near.quality[180], 47) << "a wall half a metre ahead";
  EXPECT_NEAR(far.quality[180], 47.0 / 9.0, 1.0) << "three metres";
  EXPECT_LT(far.quality[120], far.quality[180]) << "farther, and met askew";
  EXPECT_GE(far.quality[120], 1);
}

TEST(Lidar, NoiseQuantisationAndDropoutFollowTheModel) {
  RobotModel model;
  model.lidar.dropout = 0.05;
  Simulation s = make(square_room(4.0), model);
  double sum2 = 0.0;
  int returned = 0;
  int lost = 0;
  constexpr std::size_t kAhead = 180;
  for (int i = 0; i < 4000; ++i) {
    const float range = s.scan().ranges_m[kAhead];
    if (!std::isfinite(range)) {
      ++lost;
      continue;
    }
    const double error = range - (2.0 - 0.021);
    sum2 += error * error;
    ++returned;
    EXPECT_NEAR(std::remainder(static_cast<double>(range), 0.001), 0.0, 1e-6);
  }
  EXPECT_NEAR(std::sqrt(sum2 / returned), 0.010, 0.001);
  EXPECT_NEAR(lost / 4000.0, 0.05, 0.015);
}

TEST(Lidar, LosesGrazingReturnsAndLowThings) {
  World world = square_room(6.0);
  world.boxes.push_back({Pose2{1.5, 0.0, 0.0}, 0.4, 0.4, 0.0, 0.2, {}});  // lower than the scanner
  Wall along;                                                             // nearly along the beam ahead
  along.a = {1.0, 0.10};
  along.b = {2.9, 0.12};
  world.walls.push_back(along);
  RobotModel model;
  model.lidar.dropout = 0.0;
  Simulation s = make(world, model);
  const LaserScan scan = s.scan();
  EXPECT_NEAR(scan.ranges_m[180], 3.0 - 0.021, 0.06);
  // 2.5 degrees to the left: meets the wall at an incidence of about 88 degrees.
  EXPECT_FALSE(std::isfinite(scan.ranges_m[185]) && scan.ranges_m[185] < 2.5F);
}

TEST(Sonar, RingHasThePosesOfTheHardware) {
  Simulation s = make(square_room(4.0), without_errors(RobotModel{}));
  const SonarScan scan = s.sonar();
  ASSERT_EQ(scan.readings.size(), 8U);
  const double bearings_deg[] = {90, 50, 30, 10, -10, -30, -50, -90};
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(rad_to_deg(scan.readings[i].base_T_sonar.theta_rad), bearings_deg[i], 1e-9);
  }
  EXPECT_DOUBLE_EQ(scan.readings[0].base_T_sonar.x_m, 0.069);
  EXPECT_DOUBLE_EQ(scan.readings[0].base_T_sonar.y_m, 0.136);
  // To the left: straight at the wall. At 10 degrees the cone holds the perpendicular, which is nearer than the axis.
  EXPECT_NEAR(scan.readings[0].range_m, 2.0 - 0.136, 1e-3);
  EXPECT_NEAR(scan.readings[3].range_m, 2.0 - 0.166, 0.01);
}

TEST(Sonar, WallBeyondTheSpecularAngleGivesNoEchoAndACornerDoes) {
  SonarModel model = without_errors(RobotModel{}).sonar;
  model.base_T_sonar = {Pose2{}};
  World world = square_room(40.0);
  Wall slanted;  // 50 degrees from the axis' perpendicular: beyond 25 degrees even at the edge of the cone
  const double slope = deg_to_rad(40.0);
  slanted.a = Point2(2.0, 0.0) - 5.0 * Point2(std::cos(slope), std::sin(slope));
  slanted.b = Point2(2.0, 0.0) + 5.0 * Point2(std::cos(slope), std::sin(slope));
  world.walls.push_back(slanted);
  world.min_corner = {-20.0, -20.0};
  Rng rng(5);
  EXPECT_EQ(ping(model, Scene(world), Pose2{}, RobotTime{}, rng).readings[0].range_m, kNoReturn);
  // The same wall ending in the cone: its edge is heard.
  world.walls.back().b = {2.0, 0.0};
  EXPECT_NEAR(ping(model, Scene(world), Pose2{}, RobotTime{}, rng).readings[0].range_m, 2.0, 0.05);
}

TEST(Sonar, TellsTheNearestThingOfTheConeWithinItsRange) {
  SonarModel model = without_errors(RobotModel{}).sonar;
  model.base_T_sonar = {Pose2{}};
  World world = square_room(30.0);
  Rng rng(5);
  EXPECT_EQ(ping(model, Scene(world), Pose2{}, RobotTime{}, rng).readings[0].range_m, kNoReturn);
  world.cylinders.push_back({Point2(3.0, 0.0), 0.3, 0.0, 1.0, {}});
  world.cylinders.push_back({Point2(2.0, 0.35), 0.1, 0.0, 1.0, {}});  // 10 degrees off the axis
  const float range = ping(model, Scene(world), Pose2{}, RobotTime{}, rng).readings[0].range_m;
  EXPECT_NEAR(range, std::hypot(2.0, 0.35) - 0.1, 0.01);
  world.cylinders.push_back({Point2(0.2, 0.0), 0.1, 0.0, 1.0, {}});
  EXPECT_FLOAT_EQ(ping(model, Scene(world), Pose2{}, RobotTime{}, rng).readings[0].range_m, 0.15F);
}

TEST(Sonar, CrossTalkHasItsProbability) {
  SonarModel model = RobotModel{}.sonar;
  model.base_T_sonar = {Pose2{}};
  model.cross_talk = 0.1;
  const Scene scene(square_room(8.0));
  Rng rng(11);
  int early = 0;
  for (int i = 0; i < 5000; ++i) {
    early += ping(model, scene, Pose2{}, RobotTime{}, rng).readings[0].range_m < 3.8F ? 1 : 0;
  }
  // A stray echo is uniform over the range; three quarters of them come before the wall.
  EXPECT_NEAR(early / 5000.0, 0.1 * (3.8 - 0.15) / (5.0 - 0.15), 0.015);
}

}  // namespace
}  // namespace seeker::sim
