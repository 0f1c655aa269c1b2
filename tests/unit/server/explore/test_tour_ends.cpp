// How explorations by the strategy that plans tours end.

#include <optional>

#include <gtest/gtest.h>

#include "tests/support/matchers.hpp"
#include "tests/unit/server/explore/explorations.hpp"

namespace seeker::explore {
namespace {

using seeker::testing::Point2Near;

/// Two rooms of 5 x 5 m joined by a door of 1.2 m.
ToyWorld rooms_with_a_door() {
  ToyWorld world;
  world.walls = joined(box(0, 0, 10.2, 5), {{{5.1, 0.0}, {5.1, 1.9}}, {{5.1, 3.1}, {5.1, 5.0}}});
  return world;
}

ToyRun tour_of(const ToyWorld& world, const Pose2& start, double limit_s, const ExploreRequest& request,
               double laser_range_m = 8.0) {
  auto exploration = exploration_of(request);
  ToyExplorer robot(world, start, 5, laser_range_m);
  ToyRun run = robot.run(exploration, limit_s);
  print("tour", run);
  return run;
}

TEST(TourEnds, ACorridorOfRoomsIsComplete) {
  const ToyRun run = tour_of(seeker::explore::office(), {9.0, 5.0, 1.5}, 900.0, request_of(Strategy::kTour));
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete) << run.end->cause;
  EXPECT_GT(run.wall_share, 0.97);
}

TEST(TourEnds, AClosetBehindAGapIsListedAsUnreachable) {
  ToyWorld world;
  world.walls = joined(box(0, 0, 9, 5), {{{5.1, 0.0}, {5.1, 2.35}}, {{5.1, 2.75}, {5.1, 5.0}}});
  const ToyRun run = tour_of(world, {3.0, 2.5, 0.0}, 600.0, request_of(Strategy::kTour));
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kUnreachable);
  ASSERT_FALSE(run.end->unreachable.empty());
  EXPECT_GT(run.end->unreachable.front().p_map.x(), 5.1);
  EXPECT_FALSE(run.end->remedy.empty());
}

TEST(TourEnds, ADoorToTheOutsideEndsAtTheBound) {
  ExploreRequest request = request_of(Strategy::kTour);
  request.areas.bound = Polygon{{-0.5, -0.5}, {5.1, -0.5}, {5.1, 5.5}, {-0.5, 5.5}};
  const ToyRun run = tour_of(rooms_with_a_door(), {1.0, 1.0, 0.3}, 600.0, request);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kBoundReached) << run.end->cause;
  EXPECT_LT(run.pose.x_m, 5.2);
}

/// The laser sees through it, the sonars do not.
TEST(TourEnds, GlassThatTheLaserSeesThroughIsNotHit) {
  ToyWorld world;
  world.walls = box(0, 0, 9, 4);
  world.low_things = {{{5.0, 0.0}, {5.0, 4.0}}};
  const ToyRun run = tour_of(world, {1.5, 2.0, 0.0}, 900.0, request_of(Strategy::kTour));
  ASSERT_TRUE(run.end.has_value());
  EXPECT_TRUE(run.end->kind == EndKind::kUnreachable || run.end->kind == EndKind::kComplete) << run.end->cause;
  EXPECT_LT(run.pose.x_m, 5.0);
  EXPECT_GT(run.least_clearance_m, 0.2);
}

TEST(TourEnds, AStartBoxedInEndsSoonWithItsReason) {
  for (const double side_m : {0.7, 1.2}) {
    ToyWorld world;
    const double half = side_m / 2.0;
    world.walls = joined(box(-5, -5, 5, 5), box(-half, -half, half, half));
    const ToyRun run = tour_of(world, {}, 120.0, request_of(Strategy::kTour));
    ASSERT_TRUE(run.end.has_value());
    EXPECT_TRUE(run.end->kind == EndKind::kComplete || run.end->kind == EndKind::kUnreachable);
    EXPECT_FALSE(run.end->cause.empty());
    EXPECT_LT(run.path_m, 2.0);
  }
}

TEST(TourEnds, AHallBeyondTheRangeOfTheLaserIsExploredToItsWalls) {
  ToyWorld world;
  world.walls = box(0, 0, 18, 18);
  const ToyRun run = tour_of(world, {9.0, 9.0, 0.0}, 1500.0, request_of(Strategy::kTour), 5.0);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete) << run.end->cause;
  EXPECT_GT(run.wall_share, 0.9);
}

TEST(TourEnds, PeopleInADoorDelayIt) {
  auto exploration = exploration_of(request_of(Strategy::kTour));
  ToyExplorer robot(rooms_with_a_door(), {1.0, 1.0, 0.3}, 19);
  ToyExplorer::Hooks hooks;
  hooks.world = [walls = robot.world().walls.size()](double t_s, ToyWorld& world) {
    world.walls.resize(walls);
    if (t_s > 2.0 && t_s < 60.0) {
      world.walls = joined(world.walls, box(4.9, 2.0, 5.3, 3.0));
    }
  };
  const ToyRun run = robot.run(exploration, 900.0, hooks);
  print("people", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete) << run.end->cause;
  EXPECT_GT(run.wall_share, 0.9);
}

TEST(TourEnds, WhoStaysInADoorMakesWhatLiesBehindUnreachable) {
  auto exploration = exploration_of(request_of(Strategy::kTour));
  ToyExplorer robot(rooms_with_a_door(), {2.0, 2.5, 0.0}, 19);
  ToyExplorer::Hooks hooks;
  hooks.world = [walls = robot.world().walls.size()](double t_s, ToyWorld& world) {
    world.walls.resize(walls);
    if (t_s > 3.5) {
      world.walls = joined(world.walls, box(4.9, 2.0, 5.3, 3.0));
    }
  };
  const ToyRun run = robot.run(exploration, 900.0, hooks);
  print("stays", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kUnreachable) << run.end->cause;
  EXPECT_GT(run.seconds, 120.0) << "it has been waited for";
}

TEST(TourEnds, ReturnsToTheStart) {
  ExploreRequest request = request_of(Strategy::kTour);
  request.return_to_start = true;
  const ToyRun run = tour_of(rooms_with_a_door(), {1.0, 1.0, 0.3}, 600.0, request);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete) << run.end->cause;
  EXPECT_THAT(run.pose.translation(), Point2Near(Point2(1.0, 1.0), 0.2));
}

}  // namespace
}  // namespace seeker::explore
