// Explorations through narrow doors.

#include <iostream>
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

}  // namespace
}  // namespace seeker::explore
