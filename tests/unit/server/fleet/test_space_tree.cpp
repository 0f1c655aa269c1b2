#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/fleet/space_tree.hpp"
#include "tests/support/toy_world.hpp"

namespace seeker::fleet {
namespace {

using seeker::testing::box;
using seeker::testing::ToyWorld;

/// Beams without noise, evenly over the field of view.
LaserScan scan_in(const ToyWorld& world, const Pose2& world_T_base, double fov_rad, int beams, double range_max_m) {
  LaserScan scan;
  scan.angle_min_rad = -0.5 * fov_rad;
  scan.angle_step_rad = fov_rad / (beams - 1);
  scan.range_max_m = range_max_m;
  for (int k = 0; k < beams; ++k) {
    const double angle = world_T_base.theta_rad + scan.angle_rad(static_cast<std::size_t>(k));
    const double range = world.ray(world_T_base.translation(), angle, range_max_m);
    scan.ranges_m.push_back(range < range_max_m ? static_cast<float>(range) : kNoReturn);
  }
  return scan;
}

LaserScan half_turn_in(const ToyWorld& world, const Pose2& world_T_base) {
  return scan_in(world, world_T_base, kPi, 361, 10.0);
}

/// A corridor 2 m wide, 6 m ahead of the robot crossed by another.
ToyWorld crossing() {
  ToyWorld world;
  world.walls = {{{-1, 1}, {5, 1}}, {{-1, -1}, {5, -1}}, {{5, 1}, {5, 9}}, {{5, -1}, {5, -9}}, {{7, -9}, {7, 9}}};
  return world;
}

TEST(SpaceTree, LooksDownACorridor) {
  const SpaceTree tree = build_space_tree(half_turn_in(crossing(), {0.0, 0.0, 0.0}));
  ASSERT_TRUE(tree.main_goal.has_value());
  const SpaceGoal& main = tree.goals[*tree.main_goal];
  // Layers are 1 + l * 9/8 m: the farthest that ends before the wall 7 m ahead is the fifth, at 6.625 m.
  EXPECT_EQ(main.layer, 5);
  EXPECT_NEAR(main.p_base.x(), 6.625 - 0.7, 1e-2);
  EXPECT_NEAR(main.p_base.y(), 0.0, 0.05);
  EXPECT_TRUE(tree.admits({5.0, 0.0}));
  EXPECT_FALSE(tree.admits({8.0, 0.0}));
  EXPECT_FALSE(tree.admits({2.0, 1.5}));
}

TEST(SpaceTree, RefusesAGapThatTheRobotDoesNotFitThrough) {
  for (const double gap_m : {0.6, 0.8}) {
    ToyWorld world;
    world.walls = {{{3.0, -9.0}, {3.0, -0.5 * gap_m}}, {{3.0, 0.5 * gap_m}, {3.0, 9.0}}};
    const SpaceTree tree = build_space_tree(half_turn_in(world, {}));
    EXPECT_EQ(tree.admits({5.0, 0.0}), gap_m > 0.7) << gap_m;
    EXPECT_TRUE(tree.admits({2.0, 0.0}));
  }
}

TEST(SpaceTree, GivesNoGoalsWhereEverythingIsNear) {
  ToyWorld world;
  world.walls = box(-1.2, -1.2, 1.2, 1.2);
  EXPECT_TRUE(build_space_tree(half_turn_in(world, {})).goals.empty());
}

TEST(SpaceTree, IsEmptyForAScanWithoutBeams) {
  const SpaceTree tree = build_space_tree({});
  EXPECT_TRUE(tree.sections.empty());
  EXPECT_FALSE(tree.main_goal.has_value());
}

TEST(SpaceTree, GivesSeveralGoalsToOpenGround) {
  const ToyWorld open;
  const SpaceTree half = build_space_tree(half_turn_in(open, {}));
  EXPECT_EQ(half.goals.size(), 3U);  // 180 degrees in sections of at most 60
  const SpaceTree whole = build_space_tree(scan_in(open, {}, kTwoPi * 359.0 / 360.0, 360, 10.0));
  EXPECT_EQ(whole.goals.size(), 6U);
  EXPECT_NEAR(whole.goals.front().p_base.norm(), 9.3, 1e-9);
}

TEST(SpaceTree, DoesNotCutASectionBehindTheRobot) {
  ToyWorld world;  // a corridor along x, closed ahead; the scanner's seam points backwards
  world.walls = {{{-20, 1}, {1.5, 1}}, {{-20, -1}, {1.5, -1}}, {{1.5, -1}, {1.5, 1}}};
  const SpaceTree tree = build_space_tree(scan_in(world, {}, kTwoPi * 719.0 / 720.0, 720, 10.0));
  ASSERT_TRUE(tree.main_goal.has_value());
  EXPECT_NEAR(tree.goals[*tree.main_goal].p_base.x(), -9.3, 0.05);
  EXPECT_NEAR(tree.goals[*tree.main_goal].p_base.y(), 0.0, 0.2);
}

TEST(SpaceTree, SpeaksInTheFrameOfTheBase) {
  ToyWorld world;
  world.walls = {{{-1, 1}, {9, 1}}, {{-1, -1}, {9, -1}}};
  LaserScan scan = half_turn_in(world, {0.2, 0.0, kPi / 2.0 - kPi / 2.0});
  scan.base_T_laser = {0.2, 0.0, 0.0};
  const SpaceTree ahead = build_space_tree(scan);
  scan = half_turn_in(world, {0.0, 0.0, kPi / 2.0});  // the laser looks to the left of the base
  scan.base_T_laser = {0.0, 0.0, kPi / 2.0};
  const SpaceTree aside = build_space_tree(scan);
  EXPECT_TRUE(ahead.admits({5.0, 0.0}));
  EXPECT_TRUE(aside.admits({5.0, 0.0}));
  EXPECT_FALSE(aside.admits({0.0, 3.0}));
}

TEST(MainGoal, IsTheOutermostThenTheOneWithTheSmallestHeadingChange) {
  const std::vector<GoalDirection> goals{{5, 1.0}, {8, -2.0}, {8, 1.5}, {7, 0.0}};
  EXPECT_EQ(main_goal_of(goals, 0.0), 2U);
  EXPECT_EQ(main_goal_of(goals, -1.5), 1U);
  EXPECT_EQ(main_goal_of({}, 0.0), std::nullopt);
}

/// Boxes strewn around the robot.
ToyWorld strewn(const std::vector<std::pair<int, int>>& places) {
  ToyWorld world;
  for (const auto& [angle_deg, range_dm] : places) {
    const double angle = deg_to_rad(angle_deg);
    const double range = 0.1 * range_dm;
    const Point2 p = range * Point2(std::cos(angle), std::sin(angle));
    const auto walls = box(p.x() - 0.2, p.y() - 0.2, p.x() + 0.2, p.y() + 0.2);
    world.walls.insert(world.walls.end(), walls.begin(), walls.end());
  }
  return world;
}

auto arbitrary_places() {
  return rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange(-180, 180), rc::gen::inRange(8, 90)));
}

bool blocked(const LaserScan& scan, double direction_rad, double radius_m, double width_m) {
  for (std::size_t k = 0; k < scan.ranges_m.size(); ++k) {
    if (std::isfinite(scan.ranges_m[k])) {
      const double range = static_cast<double>(scan.ranges_m[k]);
      const double off = scan.angle_rad(k) - direction_rad;
      const double along = range * std::cos(off);
      if (along > 0.0 && along <= radius_m && std::abs(range * std::sin(off)) <= 0.5 * width_m) {
        return true;
      }
    }
  }
  return false;
}

RC_GTEST_PROP(SpaceTree, EveryDirectionOfASectionIsFreeOfHits, ()) {
  const LaserScan scan = scan_in(strewn(*arbitrary_places()), {}, kTwoPi * 359.0 / 360.0, 360, 10.0);
  for (const SpaceSection& section : build_space_tree(scan).sections) {
    constexpr double kEdge_rad = 1e-6;  // a hit on the very border is a matter of rounding
    for (const double part : {0.0, 0.3, 0.5, 0.9, 1.0}) {
      const double inside = std::clamp(part * section.span_rad, kEdge_rad, section.span_rad - kEdge_rad);
      RC_ASSERT(!blocked(scan, section.start_rad + inside, section.radius_m - 1e-6, 0.70 - 1e-6));
    }
  }
}

RC_GTEST_PROP(SpaceTree, EveryFreeDirectionIsInASection, ()) {
  const LaserScan scan = scan_in(strewn(*arbitrary_places()), {}, kPi, 181, 10.0);
  const SpaceTree tree = build_space_tree(scan);
  const double direction = deg_to_rad(*rc::gen::inRange(-79, 80));
  for (const double radius : {2.0, 5.0, 9.0}) {
    const bool in_any = tree.admits(radius * Point2(std::cos(direction), std::sin(direction)));
    // Layers lie up to 1.25 m apart, so that free ground is admitted up to the last layer before it ends.
    if (in_any) {
      RC_ASSERT(!blocked(scan, direction, radius - 1e-6, 0.70 - 1e-6));
    }
    // So wide that no layer drops it: the nearest hit is 0.5 m away or farther.
    const double margin = std::asin(0.5 * 0.25 * 0.70 / 0.5);
    bool open = true;
    for (double off = -margin; open && off <= margin; off += deg_to_rad(0.25)) {
      open = !blocked(scan, direction + off, radius + 1.25, 0.70 + 1e-6);
    }
    if (open && radius + 1.25 <= 10.0) {
      RC_ASSERT(in_any);
    }
  }
}

RC_GTEST_PROP(SpaceTree, SectionsLieInsideTheirParents, ()) {
  const LaserScan scan = scan_in(strewn(*arbitrary_places()), {}, kTwoPi * 359.0 / 360.0, 360, 10.0);
  const SpaceTree tree = build_space_tree(scan);
  for (const SpaceSection& section : tree.sections) {
    RC_ASSERT(section.parent.has_value() == (section.layer > 0));
    if (section.parent) {
      const SpaceSection& parent = tree.sections[*section.parent];
      RC_ASSERT(parent.layer == section.layer - 1);
      RC_ASSERT(!parent.leaf);
      RC_ASSERT(section.span_rad <= parent.span_rad + 1e-9);
      const double middle = section.start_rad + 0.5 * section.span_rad;
      const double off = wrap_angle(middle - parent.start_rad - 0.5 * parent.span_rad);
      RC_ASSERT(std::abs(off) + 0.5 * section.span_rad <= 0.5 * parent.span_rad + 1e-6);
    }
  }
}

RC_GTEST_PROP(SpaceTree, GoalsLieOnLeavesAndCanBeDrivenTo, ()) {
  const LaserScan scan = scan_in(strewn(*arbitrary_places()), {}, kPi, 181, 10.0);
  const SpaceTree tree = build_space_tree(scan);
  for (const SpaceGoal& goal : tree.goals) {
    RC_ASSERT(tree.sections[goal.section].leaf);
    RC_ASSERT(tree.admits(goal.p_base));
    RC_ASSERT(goal.p_base.norm() >= 1.5 - 0.70 - 1e-9);
  }
  RC_ASSERT(tree.main_goal.has_value() == !tree.goals.empty());
}

}  // namespace
}  // namespace seeker::fleet
