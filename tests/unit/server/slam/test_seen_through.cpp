#include "server/slam/seen_through.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "rooms.hpp"

namespace seeker::slam {
namespace {

/// Of a pillar 3 m ahead as it is seen from `map_T_base`.
ReferenceCloud pillar_from(const Pose2& map_T_base) {
  Rng rng(1);
  std::vector<OrientedPoint> points = oriented_points(scan_at(box(3.0, -0.3, 3.4, 0.3), map_T_base, 0.0, rng));
  for (OrientedPoint& point : points) {
    point = transform(map_T_base, point);
  }
  return ReferenceCloud(std::move(points));
}

double seen_through_in(const std::vector<Wall>& walls, const Pose2& map_T_base) {
  Rng rng(2);
  return seen_through(pillar_from({}), scan_at(walls, map_T_base, 0.0, rng), map_T_base);
}

const std::vector<Wall> kPillarAndWall = [] {
  std::vector<Wall> walls = box(3.0, -0.3, 3.4, 0.3);
  walls.push_back({{8.0, -5.0}, {8.0, 5.0}});
  walls.push_back({{-2.0, 5.0}, {-2.0, -5.0}});
  return walls;
}();

TEST(SeenThrough, WhatIsWhereItWasIsNotSeenThrough) {
  EXPECT_EQ(seen_through_in(kPillarAndWall, {}), 0.0);
  EXPECT_LT(seen_through_in(kPillarAndWall, {1.0, 0.5, 0.1}), 0.1) << "but for a beam beside its edge";
}

TEST(SeenThrough, AScanThatSeesTheWallBehindGoesThrough) {
  EXPECT_GT(seen_through_in({{{8.0, -5.0}, {8.0, 5.0}}}, {}), 0.9);
}

TEST(SeenThrough, TheOtherFaceDeniesNothing) { EXPECT_EQ(seen_through_in(kPillarAndWall, {6.0, 0.0, kPi}), 0.0); }

TEST(SeenThrough, WhatIsHiddenOrOutOfViewOrDoesNotComeBackIsNeither) {
  std::vector<Wall> hidden = kPillarAndWall;
  hidden.push_back({{1.0, -2.0}, {1.0, 2.0}});
  EXPECT_EQ(seen_through_in(hidden, {}), 0.0);
  EXPECT_EQ(seen_through_in({{{-2.0, 5.0}, {-2.0, -5.0}}}, {0.0, 0.0, kPi}), 0.0);
  EXPECT_EQ(seen_through_in({}, {}), 0.0);
}

TEST(SeenThrough, ItIsTheSameInWhicheverDirectionTheScannerRotates) {
  Rng rng(3);
  LaserScan scan = scan_at({{{8.0, -5.0}, {8.0, 5.0}}}, {}, 0.0, rng);
  const ReferenceCloud pillar = pillar_from({});
  const double share = seen_through(pillar, scan, {});
  scan.angle_min_rad = scan.angle_rad(scan.ranges_m.size() - 1);
  scan.angle_step_rad = -scan.angle_step_rad;
  std::reverse(scan.ranges_m.begin(), scan.ranges_m.end());
  EXPECT_DOUBLE_EQ(seen_through(pillar, scan, {}), share);
  EXPECT_GT(share, 0.9);
}

}  // namespace
}  // namespace seeker::slam
