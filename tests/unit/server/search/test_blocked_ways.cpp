// Searches while somebody stands in a door, or around the robot.

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "server/search/search_mission.hpp"
#include "tests/unit/server/search/toy_world.hpp"

namespace seeker::search {
namespace {

/// Two rooms, of 5 x 5 m and of 8 x 5 m, joined by a door of 1.2 m.
ToyWorld two_rooms() {
  ToyWorld world;
  world.walls = box(0, 0, 13.1, 5);
  world.walls.push_back({{5.1, 0.0}, {5.1, 1.9}});
  world.walls.push_back({{5.1, 3.1}, {5.1, 5.0}});
  return world;
}
constexpr double kBothRooms_m2 = 47.0;
/// So slow that it comes to rest before somebody who steps in its path 0.8 m ahead.
constexpr double kCanStop_m_s = 0.5;

/// Somebody steps into the door as the robot comes near it, and stands there for so long.
struct Passer {
  double stays_s;
  std::optional<double> came_s = {};

  void operator()(double t_s, ToyRobot& robot, std::size_t walls) {
    constexpr double kNear_m = 0.8;
    if (!came_s && (Point2(4.9, 2.5) - robot.pose().translation()).norm() < kNear_m) {
      came_s = t_s;
    }
    robot.world().walls.resize(walls);
    if (came_s && t_s < *came_s + stays_s) {
      for (const Wall& wall : box(4.9, 2.1, 5.3, 2.9)) {
        robot.world().walls.push_back(wall);
      }
    }
  }
};

ToyRun run_with_somebody_in_the_door(SearchMission& mission, double stays_s) {
  ToyRobot robot(two_rooms(), {1.0, 1.0, 0.3}, true, 5);
  Passer passer{stays_s};
  robot.between = [&, walls = robot.world().walls.size()](double t_s) { passer(t_s, robot, walls); };
  ToyRun run = robot.run(mission, 1800.0);
  EXPECT_TRUE(passer.came_s.has_value());
  return run;
}

bool waited(const ToyRun& run) {
  return std::any_of(run.events.begin(), run.events.end(), [](const SearchEvent& e) { return e.kind == "wait"; });
}

TEST(BlockedSearch, WhoStepsIntoTheDoorForAMomentDelaysItOnly) {
  auto mission = planned_search(kCanStop_m_s);
  const ToyRun run = run_with_somebody_in_the_door(mission, 1.5);
  print("a moment", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kNotFoundAreaCovered);
  EXPECT_GT(run.summary.reachable_area_m2, kBothRooms_m2);
  EXPECT_GE(run.summary.covered_area_m2, 0.97 * run.summary.reachable_area_m2);
}

TEST(BlockedSearch, WhoStandsInTheDoorForMinutesIsWaitedFor) {
  auto mission = planned_search(kCanStop_m_s);
  const ToyRun run = run_with_somebody_in_the_door(mission, 120.0);
  print("minutes", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_TRUE(waited(run));
  EXPECT_GT(run.summary.reachable_area_m2, kBothRooms_m2) << run.end->cause;
  EXPECT_GE(run.summary.covered_area_m2, 0.97 * run.summary.reachable_area_m2);
}

TEST(BlockedSearch, WhoStandsAgainstTheRobotIsWaitedFor) {
  auto mission = planned_search();
  const ToyRun run = run_with_somebody_in_the_door(mission, 100.0);
  print("against the robot", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_TRUE(waited(run));
  EXPECT_EQ(run.end->kind, EndKind::kNotFoundAreaCovered);
  EXPECT_GE(run.summary.covered_area_m2, 0.97 * run.summary.reachable_area_m2);
}

TEST(BlockedSearch, WhoStaysInTheDoorMakesAGapOfWhatLiesBehind) {
  auto mission = planned_search(kCanStop_m_s);
  const ToyRun run = run_with_somebody_in_the_door(mission, 1e6);
  print("for good", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kNotFoundAreaCovered);
  EXPECT_LT(run.seconds, 600.0);
  EXPECT_LT(run.summary.covered_area_m2, 0.95 * run.summary.reachable_area_m2) << run.end->cause;
  EXPECT_FALSE(run.end->remedy.empty());
  const auto gaps = mission.evidence_report().gaps;
  EXPECT_TRUE(std::any_of(gaps.begin(), gaps.end(), [](const Gap& gap) {
    return gap.reason == "cut off" && gap.centre_map.x() > 5.3 && gap.area_m2 > 1.0;
  }));
}

TEST(BlockedSearch, HemmedInAfterManyCellsItTellsThatItCannotGetOut) {
  auto mission = planned_search();
  ToyRobot robot(two_rooms(), {2.5, 2.5, 0.0}, true, 5);
  std::optional<Point2> at;
  robot.between = [&](double t_s) {
    const bool stands = std::abs(robot.twist().v_m_s) + std::abs(robot.twist().omega_rad_s) < 1e-3;
    if (!at && t_s > 12.0 && stands) {
      at = robot.pose().translation();
      for (const Wall& wall : box(at->x() - 0.33, at->y() - 0.33, at->x() + 0.33, at->y() + 0.33)) {
        robot.world().walls.push_back(wall);
      }
    }
  };
  const ToyRun run = robot.run(mission, 600.0);
  print("hemmed in", run);
  ASSERT_TRUE(at && run.end);
  EXPECT_GT(run.lists.searched.size(), 1U);
  EXPECT_EQ(run.end->kind, EndKind::kUnreachable) << run.end->cause;
  ASSERT_FALSE(run.end->unreachable.empty());
  EXPECT_EQ(run.end->unreachable.front().cause, UnreachableCause::kRobotEnclosed);
}

/// Neither the laser nor the sonars show what holds the robot.
TEST(BlockedSearch, WhatWasGivenUpIsListedWithTheWidthOfWhatIsLeftThere) {
  auto mission = planned_search();
  ToyRobot robot(two_rooms(), {1.0, 1.0, 0.3}, true, 5);
  robot.between = [&](double t_s) { robot.held = t_s > 14.0; };
  const ToyRun run = robot.run(mission, 3600.0);
  print("held", run);
  ASSERT_TRUE(run.end.has_value());
  ASSERT_FALSE(run.end->unreachable.empty()) << run.end->cause;
  EXPECT_EQ(run.end->unreachable.size(), run.lists.unreachable.size());
  for (const UnreachablePlace& place : run.end->unreachable) {
    EXPECT_EQ(place.cause, UnreachableCause::kBlocked);
    EXPECT_GT(place.size_m, 0.0) << describe(place);
  }
}

}  // namespace
}  // namespace seeker::search
