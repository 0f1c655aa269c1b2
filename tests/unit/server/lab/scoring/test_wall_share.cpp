#include "server/lab/scoring/wall_share.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "server/options/world_options.hpp"
#include "tests/support/data.hpp"

namespace seeker::lab {
namespace {

sim::Wall wall(const Point2& a, const Point2& b) {
  sim::Wall wall;
  wall.a = a;
  wall.b = b;
  return wall;
}

/// A room of 6 x 4 m with a shelf of 0.5 x 1 m in its middle and a chamber nobody can enter behind its right wall.
sim::World room() {
  sim::World world;
  world.name = "room";
  world.min_corner = {-1.0, -1.0};
  world.max_corner = {9.0, 5.0};
  const std::vector<Point2> corners = {{0, 0}, {6, 0}, {6, 4}, {0, 4}};
  for (std::size_t n = 0; n < corners.size(); ++n) {
    world.walls.push_back(wall(corners[n], corners[(n + 1) % corners.size()]));
  }
  world.walls.push_back(wall({6.0, 0.0}, {8.0, 2.0}));
  world.walls.push_back(wall({8.0, 2.0}, {6.0, 4.0}));
  world.boxes.push_back({Pose2{3.0, 2.0, 0.0}, 0.5, 1.0, 0.0, 1.5, {}});
  world.starts = {Pose2{1.0, 2.0, 0.3}};
  return world;
}

/// The segment of a wall from a to b (frame `world`) seen from its left, in the map of a robot that began at `start`.
MapSegment mapped(const Pose2& start, const Point2& a, const Point2& b) {
  MapSegment segment;
  segment.id = 1;
  segment.length_m = (b - a).norm();
  const Point2 middle = 0.5 * (a + b);
  // Walking from b to a has the free side on the right, and that is where the left end comes first.
  const Point2 way = a - b;
  segment.map_T_segment = inverse(start) * Pose2{middle.x(), middle.y(), std::atan2(way.y(), way.x())};
  return segment;
}

std::vector<MapSegment> whole_map(const sim::World& world) {
  std::vector<MapSegment> segments;
  for (std::size_t n = 0; n < 4; ++n) {
    segments.push_back(mapped(world.starts[0], world.walls[n].a, world.walls[n].b));
  }
  return segments;
}

TEST(TrueWalls, OnlyWhatCanBeSeenFromReachableFloorCounts) {
  const TrueWalls walls = true_walls(room(), {}, std::nullopt);
  EXPECT_NEAR(walls.reachable_m(), 20.0, 0.01);  // neither the outer sides nor the chamber
  EXPECT_EQ(walls.walls.size(), 6U);
  EXPECT_EQ(walls.furniture.size(), 4U);
  for (const WallPiece& piece : walls.reachable) {
    EXPECT_GT((Point2(3.0, 2.0) - piece.p_world).dot(piece.normal), 0.0);
  }
}

TEST(TrueWalls, WallsHiddenByFurnitureOrOutOfRangeDoNotCount) {
  sim::World world = room();
  world.boxes.push_back({Pose2{3.0, 3.7, 0.0}, 2.0, 0.58, 0.0, 1.5, {}});  // a cupboard before the upper wall
  EXPECT_NEAR(true_walls(world, {}, std::nullopt).reachable_m(), 18.0, 0.25);
  sim::RobotModel short_sighted;
  short_sighted.lidar.range_max_m = 0.2;  // less than the robot's radius: it never comes so near
  EXPECT_EQ(true_walls(room(), short_sighted, std::nullopt).reachable_m(), 0.0);
}

TEST(TrueWalls, FloorBeyondTheBoundIsNotReachable) {
  sim::World world = room();
  world.walls.push_back(wall({2.5, 0.0}, {2.5, 1.5}));  // between two halves, open elsewhere
  sim::RobotModel robot;
  robot.lidar.range_max_m = 1.0;
  const double left_m = true_walls(world, robot, Polygon{{0, 0}, {2, 0}, {2, 4}, {0, 4}}).reachable_m();
  EXPECT_GT(left_m, 6.0);
  EXPECT_LT(left_m, 12.0);
}

TEST(WallShare, MapEqualToTheTruthScoresOne) {
  const sim::World world = room();
  const WallShare share = share_of_walls(whole_map(world), true_walls(world, {}, std::nullopt), world.starts[0]);
  EXPECT_TRUE(share.aligned);
  EXPECT_DOUBLE_EQ(share.share(), 1.0);
  EXPECT_NEAR(share.map_m, 20.0, 1e-9);
  EXPECT_EQ(share.false_m, 0.0);
  EXPECT_TRUE(share.missing.empty());
}

TEST(WallShare, HalfTheWallsScoreAHalf) {
  const sim::World world = room();
  std::vector<MapSegment> half = whole_map(world);
  half.resize(2);  // 6 m and 4 m of 20 m
  WallShareParams params;
  params.near_m = 0.1;
  const WallShare share = share_of_walls(half, true_walls(world, {}, std::nullopt), world.starts[0], params);
  EXPECT_NEAR(share.share(), 0.5, 0.015);
}

TEST(WallShare, ShiftedAndTurnedMapIsLaidBackByOneMotion) {
  const sim::World world = room();
  const Pose2 moved = world.starts[0] * Pose2{0.4, -0.3, 0.05};
  const WallShare share = share_of_walls(whole_map(world), true_walls(world, {}, std::nullopt), moved);
  EXPECT_DOUBLE_EQ(share.share(), 1.0);
  EXPECT_LT(distance_m(share.world_T_map, world.starts[0]), 0.005);
}

TEST(WallShare, WallSeenFromTheOtherSideOrTurnedDoesNotCount) {
  const sim::World world = room();
  const TrueWalls walls = true_walls(world, {}, std::nullopt);
  std::vector<MapSegment> turned = whole_map(world);
  turned[0] = mapped(world.starts[0], world.walls[0].b, world.walls[0].a);
  EXPECT_NEAR(share_of_walls(turned, walls, world.starts[0]).share(), 0.7, 0.001);
  std::vector<MapSegment> oblique = whole_map(world);
  oblique[0].map_T_segment.theta_rad += deg_to_rad(4.0);
  EXPECT_NEAR(share_of_walls(oblique, walls, world.starts[0]).share(), 0.7, 0.001);
}

TEST(WallShare, WallsThatAreNotThereAreMeasured) {
  const sim::World world = room();
  std::vector<MapSegment> segments = whole_map(world);
  segments.push_back(mapped(world.starts[0], {1.0, 1.0}, {1.0, 3.0}));
  segments.push_back(mapped(world.starts[0], {2.76, 1.5}, {2.76, 2.5}));  // the shelf is there
  const WallShare share = share_of_walls(segments, true_walls(world, {}, std::nullopt), world.starts[0]);
  EXPECT_NEAR(share.false_m, 2.0, 0.1);
  EXPECT_DOUBLE_EQ(share.share(), 1.0);
}

TEST(WallShare, EmptyMapScoresZeroAndIsNotAligned) {
  const sim::World world = room();
  const WallShare share = share_of_walls({}, true_walls(world, {}, std::nullopt), world.starts[0]);
  EXPECT_FALSE(share.aligned);
  EXPECT_EQ(share.share(), 0.0);
}

TEST(TrueWalls, CorridorOfThePaperHasTheWallsThatItsPlanSays) {
  const Result<sim::World> world = options::load_world(testing::source_file("config/worlds/corridor.yaml"));
  ASSERT_TRUE(world) << world.error().message;
  // Outer walls of the corridor with the recess's mouth open, its two ends, the inner walls less their doors, the
  // recess, two rooms less their doors.
  const double wall_m = true_walls(*world, {}, std::nullopt).reachable_m();
  EXPECT_NEAR(wall_m,
              (20.0 - 1.2 + 12.0) + (2.0 + 2.0) + (18.0 - 0.9) + (10.0 - 0.9) + (0.8 + 1.2 + 0.8) + 2 * (14.0 - 0.9),
              1.0);
}

}  // namespace
}  // namespace seeker::lab
