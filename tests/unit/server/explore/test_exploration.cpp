#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/core/occupancy_tile.hpp"
#include "server/nav/shared_floor.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/explore/explorations.hpp"

namespace seeker::explore {
namespace {

using seeker::testing::Point2Near;

TEST(Exploration, FrontierExploresTwoRooms) {
  auto exploration = exploration_of(request_of(Strategy::kFrontier));
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 5);
  const ToyRun run = robot.run(exploration, 600.0);
  print("frontier", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_NE(run.end->cause.find("m\xC2\xB2 of floor"), std::string::npos) << run.end->cause;
  EXPECT_EQ(run.end->remedy, "") << "there is nothing to remedy";
  EXPECT_GT(run.least_clearance_m, 0.2);
  EXPECT_GT(run.wall_share, 0.9);
  EXPECT_DOUBLE_EQ(run.progress, 1.0);
  ASSERT_FALSE(run.decisions.empty());
  EXPECT_EQ(run.decisions.front().rule, "frontier");
}

TEST(Exploration, ReturnsToTheStartAfterTheEnd) {
  ExploreRequest request = request_of(Strategy::kFrontier);
  request.return_to_start = true;
  auto exploration = exploration_of(request);
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 6);
  const ToyRun run = robot.run(exploration, 600.0);
  print("return", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_TRUE(has_event(run, "return"));
  EXPECT_THAT(run.pose.translation(), Point2Near(Point2(1.0, 1.0), 0.2));
}

/// What another robot has seen of two rooms of 5 x 5 m: free floor, and the wall with a door of 1 m between them.
nav::SharedFloor floor_with_door() {
  auto floor =
      std::make_shared<Grid<std::uint8_t>>(GridFrame{{-1.0, -1.0}, kTileResolution_m}, 250, 140, std::uint8_t{0});
  for (double y = 0.0; y < 5.0; y += kTileResolution_m) {
    (*floor)[floor->frame().cell_of({5.1, y})] = y < 2.0 || y > 3.0 ? kOccupiedCell : std::uint8_t{0};
  }
  return floor;
}

/// The end of a robot in that door.
ToyRun end_in_a_door(bool other_explores) {
  auto exploration = exploration_of(request_of(Strategy::kFrontier));
  ToyWorld world;
  world.walls = joined(box(0, 0, 10.2, 5), {{{5.1, 0.0}, {5.1, 2.0}}, {{5.1, 3.0}, {5.1, 5.0}}});
  ToyExplorer robot(world, {4.8, 2.5, 0.0}, 7);
  RobotTopology other;
  other.robot_id = "other";
  other.map_T_base = {1.0, 4.0, 0.0};
  other.active = other_explores;
  const FleetView fleet{.robot_id = "self", .others = {other}, .floor = floor_with_door()};
  ToyExplorer::Hooks hooks;
  hooks.input = [&](double, ExploreInput& input) { input.fleet = &fleet; };
  return robot.run(exploration, 300.0, hooks);
}

TEST(Exploration, DoesNotEndInADoorThroughWhichAnotherRobotMustPass) {
  const ToyRun run = end_in_a_door(true);
  print("make room", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_TRUE(has_event(run, "make-room"));
  EXPECT_GT((run.pose.translation() - Point2(5.1, 2.5)).norm(), 1.0);
  EXPECT_GT(run.least_clearance_m, 0.2);
}

TEST(Exploration, EndsInADoorWhereNobodyElseExplores) {
  const ToyRun run = end_in_a_door(false);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_FALSE(has_event(run, "make-room"));
}

TEST(Exploration, AnOpenDoorToTheOutsideOfTheBoundEndsAsBoundReached) {
  ExploreRequest request = request_of(Strategy::kFrontier);
  request.areas.bound = Polygon{{-0.5, -0.5}, {5.1, -0.5}, {5.1, 5.5}, {-0.5, 5.5}};
  auto exploration = exploration_of(request);
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 7);
  const ToyRun run = robot.run(exploration, 600.0);
  print("bound", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kBoundReached);
  EXPECT_LT(run.pose.x_m, 5.2);
}

TEST(Exploration, FloorThatIsSeenBehindAKeptOutDoorIsBeyondTheLimitsNotBlocked) {
  ExploreRequest request = request_of(Strategy::kFrontier);
  request.areas.keep_out = {{{4.6, 1.7}, {5.6, 1.7}, {5.6, 3.3}, {4.6, 3.3}}};
  auto exploration = exploration_of(request);
  ToyExplorer robot(two_rooms(), {1.5, 2.5, 0.0}, 7);
  const ToyRun run = robot.run(exploration, 600.0);
  print("kept out door", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kBoundReached) << run.end->cause;
  EXPECT_LT(run.pose.x_m, 4.6);
}

TEST(Exploration, ComesBackToItsStartThoughTheMapHasBentWhereTheRobotWas) {
  ExploreRequest request = request_of(Strategy::kFrontier);
  request.return_to_start = true;
  auto exploration = exploration_of(request);
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 6);
  ToyExplorer::Hooks hooks;
  hooks.exploration = [](double t_s, Exploration& running) {
    if (std::abs(t_s - 12.0) < 0.01) {
      // What lies far from the start is said to have moved; the toy's map stays as it is.
      running.transform(MapMove(std::vector<MapMove::Piece>{{{100.0, 0.0}, {0.0, 2.0, 0.2}}, {{1.0, 1.0}, {}}}));
    }
  };
  const ToyRun run = robot.run(exploration, 600.0, hooks);
  print("bent", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_THAT(run.pose.translation(), Point2Near(Point2(1.0, 1.0), 0.2));
}

TEST(Exploration, FloorBehindAGapTooNarrowIsListedAsUnreachable) {
  ToyWorld world;
  world.walls = joined(box(0, 0, 9, 5), {{{5.1, 0.0}, {5.1, 2.35}}, {{5.1, 2.75}, {5.1, 5.0}}});
  auto exploration = exploration_of(request_of(Strategy::kFrontier));
  ToyExplorer robot(world, {3.0, 2.5, 0.0}, 8);
  const ToyRun run = robot.run(exploration, 600.0);
  print("gap", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kUnreachable);
  ASSERT_FALSE(run.end->unreachable.empty());
  EXPECT_GT(run.end->unreachable.front().p_map.x(), 5.1);
  EXPECT_GT(run.end->unreachable.front().size_m, 0.5) << "how much is left there";
  EXPECT_NE(run.end->cause.find(" m wide: "), std::string::npos) << run.end->cause;
  EXPECT_FALSE(run.end->remedy.empty());
  EXPECT_TRUE(has_event(run, "unreachable"));
}

TEST(Exploration, AStartBoxedInEndsSoonWithItsReason) {
  for (const double side_m : {0.7, 1.2}) {
    ToyWorld world;
    const double half = side_m / 2.0;
    world.walls = joined(box(-5, -5, 5, 5), box(-half, -half, half, half));
    auto exploration = exploration_of(request_of(Strategy::kFrontier));
    ToyExplorer robot(world, {}, 9);
    const ToyRun run = robot.run(exploration, 120.0);
    print("closet", run);
    ASSERT_TRUE(run.end.has_value());
    EXPECT_TRUE(run.end->kind == EndKind::kComplete || run.end->kind == EndKind::kUnreachable);
    EXPECT_FALSE(run.end->cause.empty());
    EXPECT_LT(run.path_m, 2.0);
  }
}

TEST(Exploration, AHallBeyondTheRangeOfTheLaserIsExploredToItsWalls) {
  ToyWorld world;
  world.walls = box(0, 0, 18, 18);
  auto exploration = exploration_of(request_of(Strategy::kFrontier));
  ToyExplorer robot(world, {9.0, 9.0, 0.0}, 10, 5.0);
  const ToyRun run = robot.run(exploration, 1500.0);
  print("hall", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_GT(run.wall_share, 0.9);
}

TEST(Exploration, SameInputsGiveTheSameDecisions) {
  std::vector<ToyRun> runs;
  for (int k = 0; k < 2; ++k) {
    auto exploration = exploration_of(request_of(Strategy::kFrontier));
    ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 16);
    runs.push_back(robot.run(exploration, 600.0));
  }
  EXPECT_EQ(runs[0].decisions, runs[1].decisions);
  EXPECT_EQ(runs[0].pose, runs[1].pose);
  ASSERT_FALSE(runs[0].decisions.empty());
  for (std::size_t k = 0; k < runs[0].decisions.size(); ++k) {
    EXPECT_EQ(runs[0].decisions[k].number, k + 1);
    EXPECT_LE(runs[0].decisions[k].candidates.size(), kMaxDecisionCandidates);
  }
}

TEST(Exploration, AMapThatMovesDoesNotDisturbIt) {
  ExploreRequest request = request_of(Strategy::kFrontier);
  request.return_to_start = true;
  auto exploration = exploration_of(request);
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 17);
  ToyExplorer::Hooks hooks;
  hooks.exploration = [&, moved = false](double t_s, Exploration& running) mutable {
    if (t_s > 12.0 && !std::exchange(moved, true)) {
      const Pose2 new_T_old{2.0, -1.0, 0.5};
      robot.move_map(new_T_old);
      running.transform(new_T_old);
    }
  };
  const ToyRun run = robot.run(exploration, 600.0, hooks);
  print("moved", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_GT(run.wall_share, 0.9);
  EXPECT_THAT(run.pose.translation(), Point2Near(Point2(1.0, 1.0), 0.2));
}

/// The choice that stood when the map moved is still the one that the robot follows: its decisions are those of a run
/// whose map stays, as far as they were made before the way there ended.
TEST(Exploration, AMapThatMovesOnTheWayDoesNotChangeTheGoal) {
  const auto run_with = [](bool moves) {
    auto exploration = exploration_of(request_of(Strategy::kFrontier));
    ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 17);
    ToyExplorer::Hooks hooks;
    hooks.exploration = [&](double t_s, Exploration& running) {
      if (moves && std::abs(t_s - 12.0) < 0.01) {
        robot.move_map({0.3, 0.0, 0.0});
        running.transform(Pose2{0.3, 0.0, 0.0});
      }
    };
    return robot.run(exploration, 600.0, hooks);
  };
  const ToyRun moved = run_with(true);
  const ToyRun still = run_with(false);
  print("moved", moved);
  print("still", still);
  EXPECT_EQ(moved.decisions.size(), still.decisions.size());
  EXPECT_NEAR(moved.path_m, still.path_m, 1.0);
}

TEST(Exploration, PausedTimeDoesNotCount) {
  ExploreParams params;
  params.driver.goal_time_s = 60.0;
  auto exploration = exploration_of(request_of(Strategy::kFrontier), params);
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 18);
  const ToyRun first = robot.run(exploration, 10.0);
  EXPECT_FALSE(first.end.has_value());
  exploration.resume(robot_time_s(5000.0));
  ToyExplorer::Hooks hooks;
  hooks.input = [](double t_s, ExploreInput& input) { input.now = robot_time_s(5000.0 + t_s); };
  const ToyRun run = robot.run(exploration, 600.0, hooks);
  print("paused", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
}

TEST(Exploration, WhatOnlySonarsSeeIsAvoided) {
  ToyWorld world = two_rooms();
  world.low_things = box(2.6, 1.8, 3.4, 3.2);
  auto exploration = exploration_of(request_of(Strategy::kFrontier));
  ToyExplorer robot(world, {1.0, 2.5, 0.0}, 20);
  const ToyRun run = robot.run(exploration, 900.0);
  print("low", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_GT(run.least_clearance_m, 0.2);
}

TEST(Exploration, RoamingKeepsTheBodyOffForbiddenGroundNotOnlyItsMiddle) {
  ExploreRequest request = request_of(Strategy::kRoam);
  request.areas.keep_out = {{{2.0, -1.0}, {4.5, -1.0}, {4.5, 0.9}, {2.0, 0.9}}};
  auto exploration = exploration_of(request);
  ToyExplorer robot(two_rooms(), {0.6, 1.0, 0.0}, 3);  // its way leads along the area, 0.1 m beside it
  double least_m = 10.0;
  ToyExplorer::Hooks hooks;
  hooks.exploration = [&](double /*t_s*/, Exploration& /*running*/) {
    const Point2 p = robot.pose().translation();
    const Point2 nearest(std::clamp(p.x(), 2.0, 4.5), std::clamp(p.y(), -1.0, 0.9));
    least_m = std::min(least_m, (p - nearest).norm());
  };
  const ToyRun run = robot.run(exploration, 60.0, hooks);
  print("beside", run);
  EXPECT_GT(run.path_m, 3.0);
  EXPECT_GT(least_m, 0.24);
}

TEST(Exploration, AfterTheEndItRepeatsTheEndStandingStill) {
  ToyWorld world;
  world.walls = box(0, 0, 3, 3);
  auto exploration = exploration_of(request_of(Strategy::kFrontier));
  ToyExplorer robot(world, {1.5, 1.5, 0.0}, 21);
  const ToyRun run = robot.run(exploration, 300.0);
  ASSERT_TRUE(run.end.has_value());
  ToyExplorer again(world, {1.5, 1.5, 0.0}, 22);
  const ToyRun after = again.run(exploration, 10.0);
  EXPECT_EQ(after.end, run.end);
  EXPECT_EQ(after.path_m, 0.0);
  EXPECT_TRUE(after.events.empty());
}

TEST(Exploration, RefusesBadRequests) {
  ExploreRequest request = request_of(Strategy::kFrontier);
  request.areas.bound = Polygon{{0, 0}, {1, 1}, {1, 0}, {0, 1}};  // crosses itself
  EXPECT_FALSE(Exploration::create(request, {}).has_value());
  request.areas.bound.reset();
  request.areas.keep_out.push_back({{0, 0}, {1, 1}});
  EXPECT_FALSE(Exploration::create(request, {}).has_value());
  request.areas.keep_out.clear();
  ExploreParams params;
  params.guard.regain_position_sigma_m = params.guard.max_position_sigma_m;
  EXPECT_FALSE(Exploration::create(request, params).has_value());
  params = {};
  params.viewpoints.horizon = 0;
  EXPECT_FALSE(Exploration::create(request, params).has_value());
  params = {};
  params.one_step.v_m_s.clear();
  EXPECT_FALSE(Exploration::create(request, params).has_value());
  params = {};
  params.tour.max_places = kMostTourPlaces + 1;
  EXPECT_FALSE(Exploration::create(request, params).has_value());
  params = {};
  params.tour.free_rotation_rad = -0.1;
  const auto turns = Exploration::create(request, params);
  ASSERT_FALSE(turns.has_value());
  EXPECT_NE(turns.error().message.find("tour.free_rotation_deg"), std::string::npos) << turns.error().message;
  EXPECT_TRUE(Exploration::create(request, {}).has_value());
}

}  // namespace
}  // namespace seeker::explore
