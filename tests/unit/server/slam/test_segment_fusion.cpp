#include <gtest/gtest.h>

#include "server/slam/segment_fusion.hpp"

namespace seeker::slam {
namespace {

MapSegment wall(std::uint64_t id, double x_m, double y_m, double theta_rad, double length_m) {
  MapSegment segment;
  segment.id = id;
  segment.map_T_segment = {x_m, y_m, theta_rad};
  segment.length_m = length_m;
  segment.covariance = Matrix2::Identity() * 1e-4;
  segment.hits = 4;
  return segment;
}

TEST(SegmentFusion, MakesOneWallOfOverlappingPictures) {
  const auto walls = fuse({wall(7, 4.0, 0.02, 0.0, 4.0), wall(3, 1.0, 0.0, 0.0, 4.0)});
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_EQ(walls[0].id, 3U) << "the older id stays";
  EXPECT_NEAR(walls[0].left().x(), -1.0, 1e-9);
  EXPECT_NEAR(walls[0].right().x(), 6.0, 1e-9);
  EXPECT_NEAR(walls[0].map_T_segment.y_m, 0.01, 1e-9);
  EXPECT_EQ(walls[0].hits, 8U);
}

TEST(SegmentFusion, KeepsTheTwoFacesOfAWallApart) {
  EXPECT_EQ(fuse({wall(1, 0.0, 0.0, 0.0, 4.0), wall(2, 0.0, 0.1, 3.14159, 4.0)}).size(), 2U);
}

TEST(SegmentFusion, KeepsADoorwayOpenAndClosesAGapOfSight) {
  MapSegment left = wall(1, 0.0, 0.0, 0.0, 2.0);
  MapSegment right = wall(2, 2.15, 0.0, 0.0, 2.0);  // a gap of 0.15 m
  EXPECT_EQ(fuse({left, right}).size(), 1U);
  left.right_real = true;
  right.left_real = true;
  EXPECT_EQ(fuse({left, right}).size(), 2U);
}

TEST(SegmentFusion, KeepsParallelAndRotatedWallsApart) {
  EXPECT_EQ(fuse({wall(1, 0.0, 0.0, 0.0, 4.0), wall(2, 0.0, 0.2, 0.0, 4.0)}).size(), 2U);
  EXPECT_EQ(fuse({wall(1, 0.0, 0.0, 0.0, 4.0), wall(2, 0.0, 0.0, 0.3, 4.0)}).size(), 2U);
}

TEST(SegmentFusion, DoesNotDependOnTheFrame) {
  const Pose2 motion{30.0, -20.0, 2.0};
  auto a = wall(1, 0.0, 0.0, 0.0, 4.0);
  auto b = wall(2, 3.0, 0.05, 0.02, 4.0);
  const auto here = fuse({a, b});
  a.map_T_segment = motion * a.map_T_segment;
  b.map_T_segment = motion * b.map_T_segment;
  const auto there = fuse({a, b});
  ASSERT_EQ(here.size(), 1U);
  ASSERT_EQ(there.size(), 1U);
  EXPECT_NEAR((motion * here[0].left() - there[0].left()).norm(), 0.0, 1e-9);
  EXPECT_NEAR((motion * here[0].right() - there[0].right()).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace seeker::slam
