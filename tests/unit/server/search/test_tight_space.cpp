// Searches from places that leave the robot little room.

#include <utility>

#include <gtest/gtest.h>

#include "server/search/search_mission.hpp"
#include "tests/unit/server/search/toy_world.hpp"

namespace seeker::search {
namespace {

TEST(TightSpace, AmongChairLegsTheRoomAroundIsSearched) {
  ToyWorld world;
  world.walls = box(0, 0, 5, 5);
  constexpr double kApart_m = 0.29;
  constexpr double kThick_m = 0.01;
  for (const double dx : {-kApart_m, kApart_m}) {
    for (const double dy : {-kApart_m, kApart_m}) {
      const Point2 leg(2.51 + dx, 2.52 + dy);
      const auto sides = box(leg.x() - kThick_m, leg.y() - kThick_m, leg.x() + kThick_m, leg.y() + kThick_m);
      world.walls.insert(world.walls.end(), sides.begin(), sides.end());
    }
  }
  auto mission = planned_search();
  ToyRobot robot(world, {2.51, 2.52, 0.0}, true, 5);
  const ToyRun run = robot.run(mission, 600.0);
  print("legs", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_GT(run.summary.reachable_area_m2, 10.0) << run.end->cause;
}

TEST(TightSpace, InABoxWithoutRoomItTellsThatNothingCanBeReached) {
  ToyWorld world;
  world.walls = box(-5, -5, 5, 5);
  for (const Wall& wall : box(-0.33, -0.33, 0.33, 0.33)) {
    world.walls.push_back(wall);
  }
  auto mission = planned_search();
  ToyRobot robot(world, {}, true, 5);
  const ToyRun run = robot.run(mission, 300.0);
  print("box", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kUnreachable) << run.end->cause;
  EXPECT_NE(run.end->cause.find("walled in"), std::string::npos) << run.end->cause;
  ASSERT_FALSE(run.end->unreachable.empty());
  EXPECT_EQ(run.end->unreachable.front().cause, UnreachableCause::kRobotEnclosed);
}

}  // namespace
}  // namespace seeker::search
