#include <cmath>

#include <gtest/gtest.h>

#include "scenes.hpp"
#include "server/explore/segment_sight.hpp"

namespace seeker::explore {
namespace {

using test::kNorth;
using test::wall;

constexpr double kReach_m = 8.0;

SightWall shape_of(const MapSegment& segment) {
  return {segment.map_T_segment, segment.length_m, {segment.left_real, segment.right_real}};
}

std::optional<SeenPart> seen(const MapSegment& segment, std::vector<MapSegment> all, const Pose2& map_T_base) {
  all.push_back(segment);
  const SightScene scene(all, map_T_base.translation(), kReach_m, {});
  return scene.look(map_T_base).part_of(shape_of(segment));
}

Growth growth(const std::vector<MapSegment>& walls, const Pose2& map_T_base,
              const Grid<nav::CellState>* floor = nullptr) {
  return SightScene(walls, map_T_base.translation(), kReach_m, {}, floor).look(map_T_base).growth();
}

TEST(SegmentSight, SeesAWallAheadWithBothEnds) {
  const auto part = seen(wall({-1.0, 2.0}, {1.0, 2.0}), {}, {0.0, 0.0, kNorth});
  ASSERT_TRUE(part);
  EXPECT_NEAR(part->from_m, -1.0, 0.03);
  EXPECT_NEAR(part->to_m, 1.0, 0.03);
  EXPECT_TRUE(part->ends[0]);
  EXPECT_TRUE(part->ends[1]);
  EXPECT_EQ(part->beams, 107) << "53.1 degrees by half a degree";
}

TEST(SegmentSight, SeesNothingBehindItselfOrOutOfRange) {
  EXPECT_FALSE(seen(wall({-1.0, 2.0}, {1.0, 2.0}), {}, {0.0, 0.0, -kNorth}));
  EXPECT_FALSE(seen(wall({-1.0, 6.5}, {1.0, 6.5}), {}, {0.0, 0.0, kNorth}));
}

TEST(SegmentSight, DoesNotSeeAWallFromItsOtherSide) {
  EXPECT_FALSE(seen(wall({1.0, 2.0}, {-1.0, 2.0}), {}, {0.0, 0.0, kNorth}));
}

TEST(SegmentSight, SeesThePartThatIsNotHidden) {
  const auto part = seen(wall({-2.0, 4.0}, {2.0, 4.0}), {wall({0.0, 2.0}, {2.0, 2.0})}, {0.0, 0.0, kNorth});
  ASSERT_TRUE(part);
  EXPECT_NEAR(part->from_m, -2.0, 0.05);
  EXPECT_NEAR(part->to_m, 0.0, 0.05);
  EXPECT_TRUE(part->ends[0]);
  EXPECT_FALSE(part->ends[1]);
  EXPECT_FALSE(seen(wall({-1.0, 4.0}, {1.0, 4.0}), {wall({-2.0, 2.0}, {2.0, 2.0})}, {0.0, 0.0, kNorth}));
  EXPECT_FALSE(seen(wall({-1.0, 4.0}, {1.0, 4.0}), {wall({2.0, 2.0}, {-2.0, 2.0})}, {0.0, 0.0, kNorth}))
      << "the back of a wall hides too";
}

TEST(SegmentSight, ASecondPictureOfAWallDoesNotHideIt) {
  EXPECT_TRUE(seen(wall({-1.0, 2.0}, {1.0, 2.0}), {wall({-1.0, 1.95}, {1.0, 1.95})}, {0.0, 0.0, kNorth}));
}

TEST(SegmentSight, WallsSeenTooFlatAreNotSeen) {
  const MapSegment far = wall({4.0, 0.2}, {5.5, 0.2});
  EXPECT_FALSE(seen(far, {}, {0.0, 0.0, 0.0})) << "under 3 degrees";
  EXPECT_TRUE(seen(far, {}, {0.0, -0.5, 0.0})) << "over 7 degrees";
}

TEST(SegmentSight, AnOpenEndGrowsAsFarAsTheSightReaches) {
  const Growth both = growth({wall({-1.0, 2.0}, {1.0, 2.0})}, {0.0, 0.0, kNorth});
  EXPECT_NEAR(both.extension_m, 2.0 * (std::sqrt(36.0 - 4.0) - 1.0), 0.01);
  EXPECT_EQ(both.new_ends, 0);
  const Growth right = growth({wall({-1.0, 2.0}, {1.0, 2.0}, {true, false})}, {0.0, 0.0, kNorth});
  EXPECT_NEAR(right.extension_m, std::sqrt(36.0 - 4.0) - 1.0, 0.01) << "real ends do not grow";
}

TEST(SegmentSight, AnExtensionEndsWhereTheViewDoes) {
  // Heading 30 degrees: the view ends at 120 degrees, where the line y = 2 is at x = -1.155.
  const Growth turned = growth({wall({-1.0, 2.0}, {1.0, 2.0}, {false, true})}, {0.0, 0.0, deg_to_rad(30.0)});
  EXPECT_NEAR(turned.extension_m, 2.0 / std::tan(deg_to_rad(60.0)) - 1.0, 0.01);
  EXPECT_EQ(growth({wall({-1.0, 2.0}, {1.0, 2.0}, {false, true})}, {0.0, 0.0, deg_to_rad(-30.0)}).extension_m, 0.0)
      << "the end itself is out of view";
}

TEST(SegmentSight, AnExtensionEndsWhereItWouldBeSeenTooFlat) {
  const Growth flat = growth({wall({0.0, 0.3}, {1.0, 0.3}, {true, false})}, {0.0, 0.0, 0.0});
  EXPECT_NEAR(flat.extension_m, 0.3 / std::tan(deg_to_rad(5.0)) - 1.0, 0.01);
}

TEST(SegmentSight, AnExtensionStopsAtACrossingWhereARealEndIsExpected) {
  const Growth corner = growth(
      {wall({-1.0, 2.0}, {1.0, 2.0}, {true, false}), wall({3.0, 2.5}, {3.0, -1.0}, {true, true})}, {0.0, 0.0, kNorth});
  EXPECT_NEAR(corner.extension_m, 2.0, 0.01);
  EXPECT_EQ(corner.new_ends, 1);
}

TEST(SegmentSight, ACrossingOutOfViewPromisesNoEnd) {
  const Growth far = growth({wall({-1.0, 2.0}, {1.0, 2.0}, {true, false}), wall({5.8, 2.5}, {5.8, -1.0}, {true, true})},
                            {0.0, 0.0, kNorth});
  EXPECT_NEAR(far.extension_m, std::sqrt(32.0) - 1.0, 0.01);
  EXPECT_EQ(far.new_ends, 0);
}

TEST(SegmentSight, WhatAnotherWallHidesIsNoExtension) {
  // The screen in front hides the line y = 3 from x = 1.5 on.
  const Growth screened = growth(
      {wall({-1.0, 3.0}, {1.0, 3.0}, {true, false}), wall({0.5, 1.0}, {2.0, 1.0}, {true, true})}, {0.0, 0.0, kNorth});
  EXPECT_NEAR(screened.extension_m, 0.5, 0.1);
  const Growth hidden = growth(
      {wall({-1.0, 3.0}, {1.0, 3.0}, {true, false}), wall({0.1, 1.0}, {2.0, 1.0}, {true, true})}, {0.0, 0.0, kNorth});
  EXPECT_EQ(hidden.extension_m, 0.0) << "the end itself is hidden";
}

TEST(SegmentSight, TheSameWallFartherOnEndsAnExtensionWithoutACorner) {
  const Growth gap = growth(
      {wall({-1.0, 2.0}, {0.0, 2.0}, {true, false}), wall({1.0, 2.02}, {2.0, 2.02}, {true, true})}, {0.0, 0.0, kNorth});
  EXPECT_NEAR(gap.extension_m, 1.0, 0.01);
  EXPECT_EQ(gap.new_ends, 0);
}

TEST(SegmentSight, TwoOpenEndsNearOneCornerWillMeetThere) {
  // They meet in (1.2, 2.0): 0.2 m beyond both.
  const Growth near = growth(
      {wall({-1.0, 2.0}, {1.0, 2.0}, {true, false}), wall({1.2, 1.8}, {1.2, -1.0}, {false, true})}, {0.0, 0.0, kNorth});
  EXPECT_NEAR(near.extension_m, 0.4, 0.01);
  EXPECT_EQ(near.new_ends, 2);
  const Growth far = growth(
      {wall({-1.0, 2.0}, {1.0, 2.0}, {true, false}), wall({2.0, 1.0}, {2.0, -1.0}, {false, true})}, {0.0, 0.0, kNorth});
  EXPECT_NEAR(far.extension_m, 2.0, 0.01) << "they stop each other";
  EXPECT_EQ(far.new_ends, 0) << "but a corner so far off is a guess";
}

Grid<nav::CellState> unknown_floor() { return {{{-8.0, -8.0}, 0.05}, 320, 320, nav::CellState::kUnknown}; }

TEST(SegmentSight, AWallDoesNotGoOnWhereTheFloorWasSeenFree) {
  Grid<nav::CellState> floor = unknown_floor();
  const MapSegment open = wall({-1.0, 2.0}, {1.0, 2.0}, {true, false});
  EXPECT_NEAR(growth({open}, {0.0, 0.0, kNorth}, &floor).extension_m, std::sqrt(32.0) - 1.0, 0.01);
  for (int j = 0; j < 320; ++j) {
    for (int i = 190; i < 320; ++i) {  // from x = 1.5 m on
      floor[{i, j}] = nav::CellState::kFree;
    }
  }
  EXPECT_NEAR(growth({open}, {0.0, 0.0, kNorth}, &floor).extension_m, 0.55, 0.06);
}

TEST(SegmentSight, ObstaclesThatAreNoWallsHideToo) {
  Grid<nav::CellState> floor = unknown_floor();
  for (int i = 165; i < 200; ++i) {  // a cupboard at y = 1, x from 0.25 to 2 m
    floor[{i, 180}] = nav::CellState::kOccupied;
  }
  const MapSegment open = wall({-1.0, 3.0}, {0.5, 3.0}, {true, false});
  EXPECT_LT(growth({open}, {0.0, 0.0, kNorth}, &floor).extension_m, 0.5);
  EXPECT_GT(growth({open}, {0.0, 0.0, kNorth}).extension_m, 4.0);
}

}  // namespace
}  // namespace seeker::explore
