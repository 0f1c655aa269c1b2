#include "server/sim/rearrange.hpp"

#include "server/sim/furniture.hpp"
#include "server/sim/placement.hpp"
#include "server/sim/scene.hpp"
#include "tests/unit/server/sim/worlds.hpp"

namespace seeker::sim {
namespace {

using testing::square_room;

/// Four boxes, a table and a board on the wall.
World furnished() {
  World world = square_room(8.0);
  for (const double x : {-3.0, -1.0, 1.0, 3.0}) {
    world.boxes.push_back({Pose2{x, 3.0, 0.0}, 0.6, 0.4, 0.0, 1.0, {0.5, 0.2, 0.1, 3}});
  }
  const std::vector<Box> table = make_table({2.0, -2.0, 0.3}, {}, {}, "table");
  world.boxes.insert(world.boxes.end(), table.begin(), table.end());
  world.boxes.push_back({Pose2{0.0, -3.98, 0.0}, 0.8, 0.02, 1.0, 1.8, {0.5, 0.6, 0.1, 4}});
  return world;
}

std::size_t moved_boxes(const World& a, const World& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.boxes.size(); ++i) {
    count += a.boxes[i].world_T_box == b.boxes[i].world_T_box ? 0U : 1U;
  }
  return count;
}

TEST(MoveObjects, MovesTheShareAndLeavesTheRest) {
  const World before = furnished();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    World world = before;
    Rng rng(seed);
    const auto moved = move_objects(world, 0.3, rng);  // 2 of 6 pieces
    ASSERT_TRUE(moved) << moved.error().message;
    EXPECT_EQ(*moved, 2U);
    const std::size_t boxes = moved_boxes(before, world);
    EXPECT_TRUE(boxes == 2U || boxes == 6U) << boxes;  // the table has five parts
    EXPECT_TRUE(validate(world));
  }
}

TEST(MoveObjects, KeepsTheShapeOfAPieceOfSeveralParts) {
  const World before = furnished();
  World world = before;
  Rng rng(3);
  ASSERT_EQ(move_objects(world, 1.0, rng), 6U);
  const auto in_first = [](const World& w, std::size_t i) {
    return (inverse(w.boxes[4].world_T_box) * w.boxes[i].world_T_box).translation();
  };
  ASSERT_NE(before.boxes[4].world_T_box, world.boxes[4].world_T_box);
  for (std::size_t i = 5; i < 9; ++i) {
    EXPECT_LT((in_first(before, i) - in_first(world, i)).norm(), 1e-9);
  }
}

TEST(MoveObjects, WhatHangsStaysOnItsWallAndWhatStandsKeepsFree) {
  const World before = furnished();
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    World world = before;
    Rng rng(seed);
    ASSERT_TRUE(move_objects(world, 1.0, rng));
    EXPECT_NEAR(world.boxes.back().world_T_box.y_m, -3.98, 1e-9);
    EXPECT_GE(std::abs(world.boxes.back().world_T_box.x_m), 0.4);
    for (std::size_t i = 0; i < 4; ++i) {
      World rest = world;
      rest.boxes.erase(rest.boxes.begin() + static_cast<std::ptrdiff_t>(i));
      EXPECT_GT(Scene(rest).clearance_m(world.boxes[i].world_T_box.translation(), 1.0, {0.0, 1.0}), 0.2);
    }
    EXPECT_GT(reachable_area_m2(world, 0.3, 0.1), 0.8 * reachable_area_m2(before, 0.3, 0.1));
  }
}

TEST(MoveObjects, RefusesWhatMakesNoSense) {
  World world = furnished();
  Rng rng(1);
  EXPECT_EQ(move_objects(world, 0.0, rng).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(move_objects(world, 1.5, rng).error().code, Errc::kInvalidArgument);
  World empty = square_room(5.0);
  EXPECT_EQ(move_objects(empty, 0.5, rng).error().code, Errc::kUnreachable);
}

TEST(Stretch, PlacesGoWithTheRoomAndSizesStay) {
  const World before = furnished();
  World world = before;
  stretch(world, {1.5, 0.8});
  EXPECT_TRUE(validate(world)) << validate(world).error().message;
  EXPECT_DOUBLE_EQ(world.max_corner.x(), 1.5 * before.max_corner.x());
  EXPECT_DOUBLE_EQ(world.walls[0].a.y(), 0.8 * before.walls[0].a.y());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(world.boxes[i].world_T_box.x_m, 1.5 * before.boxes[i].world_T_box.x_m);
    EXPECT_DOUBLE_EQ(world.boxes[i].length_m, before.boxes[i].length_m);
  }
  const Pose2 leg = inverse(before.boxes[4].world_T_box) * before.boxes[5].world_T_box;
  const Pose2 leg_now = inverse(world.boxes[4].world_T_box) * world.boxes[5].world_T_box;
  EXPECT_NEAR(distance_m(leg, leg_now), 0.0, 1e-9) << "the table is still a table";
}

}  // namespace
}  // namespace seeker::sim
