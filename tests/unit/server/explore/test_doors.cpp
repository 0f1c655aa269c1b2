// Explorations through doors that are narrow, or that somebody stands in.

#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/unit/server/explore/toy_worlds.hpp"

namespace seeker::explore {
namespace {

Exploration frontier_exploration() {
  ExploreRequest request;
  request.strategy = maker_of(Strategy::kFrontier);
  auto exploration = Exploration::create(request, {});
  EXPECT_TRUE(exploration.has_value());
  return std::move(*exploration);
}

void print(const char* name, const ToyRun& run) {
  std::cout << name << ": " << (run.end ? run.end->cause : "no end") << "; " << run.seconds << " s, " << run.path_m
            << " m, walls " << run.wall_share << '\n';
}

/// Two rooms of 5 x 5 m whose door lies in a corner of a wall 0.2 m thick.
ToyWorld rooms_with_a_door_in_the_corner(double door_m) {
  const double low = 4.4 - 0.5 * door_m;
  ToyWorld world;
  world.walls = joined(joined(box(0, 0, 10.2, 5), box(5.0, 0.0, 5.2, low)), box(5.0, low + door_m, 5.2, 5.0));
  return world;
}

/// The robot stands beside the wall: it sees the door flat, and nothing of what lies behind.
TEST(Doors, ARoomBehindANarrowDoorIsEntered) {
  for (const double door_m : {0.8, 0.9, 1.0}) {
    auto exploration = frontier_exploration();
    ToyExplorer robot(rooms_with_a_door_in_the_corner(door_m), {4.6, 1.0, kPi / 2.0}, 5);
    const ToyRun run = robot.run(exploration, 600.0);
    print("narrow door", run);
    ASSERT_TRUE(run.end.has_value());
    EXPECT_EQ(run.end->kind, EndKind::kComplete);
    EXPECT_GT(run.wall_share, 0.9) << door_m << " m";
  }
}

/// Somebody stands in the door of two_rooms() for that time.
ToyExplorer::Hooks somebody_in_the_door(ToyExplorer& robot, double from_s, double until_s) {
  ToyExplorer::Hooks hooks;
  hooks.world = [walls = robot.world().walls.size(), from_s, until_s](double t_s, ToyWorld& world) {
    world.walls.resize(walls);
    if (t_s > from_s && t_s < until_s) {
      for (const Wall& wall : box(4.9, 2.0, 5.3, 3.0)) {
        world.walls.push_back(wall);
      }
    }
  };
  return hooks;
}

TEST(Doors, PeopleInTheDoorDelayItOnly) {
  auto exploration = frontier_exploration();
  ToyExplorer robot(two_rooms(), {1.0, 1.0, 0.3}, 19);
  const auto hooks = somebody_in_the_door(robot, 11.0, 50.0);  // when the robot is on its way
  const ToyRun run = robot.run(exploration, 900.0, hooks);
  print("people", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_GT(run.wall_share, 0.9);
}

/// Somebody steps into the door of two_rooms() when the robot has looked through it, and stands there until `until_s`.
ToyRun run_with_somebody_in_the_door(double until_s) {
  auto exploration = frontier_exploration();
  ToyExplorer robot(two_rooms(), {2.0, 2.5, 0.0}, 19);
  const auto hooks = somebody_in_the_door(robot, 3.5, until_s);
  const ToyRun run = robot.run(exploration, 900.0, hooks);
  print("in the door", run);
  return run;
}

TEST(Doors, WhoStandsInTheDoorForMinutesIsWaitedFor) {
  const ToyRun run = run_with_somebody_in_the_door(160.0);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete) << run.end->cause;
  EXPECT_GT(run.wall_share, 0.9);
}

TEST(Doors, WhoStaysInTheDoorMakesWhatLiesBehindUnreachable) {
  const ToyRun run = run_with_somebody_in_the_door(1e6);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kUnreachable) << run.end->cause;
  ASSERT_FALSE(run.end->unreachable.empty());
  EXPECT_GT(run.end->unreachable.front().p_map.x(), 5.0);
  EXPECT_GT(run.seconds, 120.0) << "it has been waited for";
  EXPECT_LT(run.seconds, 400.0);
}

TEST(Doors, ARobotThatIsHemmedInForAMinuteWaitsUntilItIsFree) {
  auto exploration = frontier_exploration();
  ToyExplorer robot(two_rooms(), {2.0, 2.5, 0.0}, 19);
  ToyExplorer::Hooks hooks;
  constexpr double kRoom_m = 0.33;
  std::optional<Point2> hemmed;
  hooks.world = [&, walls = robot.world().walls.size()](double t_s, ToyWorld& world) {
    world.walls.resize(walls);
    if (t_s > 6.0 && t_s < 66.0) {
      hemmed = hemmed.value_or(robot.pose().translation());
      world.walls = joined(
          world.walls, box(hemmed->x() - kRoom_m, hemmed->y() - kRoom_m, hemmed->x() + kRoom_m, hemmed->y() + kRoom_m));
    }
  };
  const ToyRun run = robot.run(exploration, 600.0, hooks);
  print("hemmed in", run);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete) << run.end->cause;
  EXPECT_GT(run.wall_share, 0.9);
  EXPECT_GT(run.seconds, 66.0);
}

TEST(Doors, WhoStepsIntoTheDoorOnTheWayHomeForAMomentDoesNotEndIt) {
  ExploreRequest request;
  request.strategy = maker_of(Strategy::kFrontier);
  request.return_to_start = true;
  auto exploration = std::move(*Exploration::create(request, {}));
  ToyWorld world_of_rooms;  // the second one so long that it has to be driven into
  world_of_rooms.walls = joined(box(0, 0, 18, 5), {{{5.1, 0.0}, {5.1, 1.9}}, {{5.1, 3.1}, {5.1, 5.0}}});
  ToyExplorer robot(world_of_rooms, {1.0, 2.5, 0.0}, 19);
  ToyExplorer::Hooks hooks;
  bool in_second_room = false;
  std::optional<double> came_s;
  hooks.world = [&, walls = robot.world().walls.size()](double t_s, ToyWorld& world) {
    in_second_room = in_second_room || robot.pose().x_m > 6.5;
    if (in_second_room && robot.pose().x_m < 5.9 && !came_s) {
      came_s = t_s;
    }
    world.walls.resize(walls);
    if (came_s && t_s < *came_s + 3.0) {
      world.walls = joined(world.walls, box(4.9, 2.2, 5.3, 2.8));
    }
  };
  const ToyRun run = robot.run(exploration, 600.0, hooks);
  print("on the way home", run);
  ASSERT_TRUE(came_s.has_value());
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->cause.find("blocked"), std::string::npos) << run.end->cause;
  EXPECT_LT((run.pose.translation() - Point2(1.0, 2.5)).norm(), 0.2);
}

}  // namespace
}  // namespace seeker::explore
