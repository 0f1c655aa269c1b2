#include "server/app/safety/recent_obstacles.hpp"

#include <gtest/gtest.h>

#include "common/core/angle.hpp"

namespace seeker::app {
namespace {

RobotTime at(double time_s) { return robot_time_s(time_s); }

/// A scan of the half plane ahead in which only the beam straight ahead has a return, or none.
LaserScan ahead(double time_s, float range_m) {
  LaserScan scan;
  scan.stamp = at(time_s);
  scan.angle_min_rad = -kPi / 2.0;
  scan.angle_step_rad = kPi / 180.0;
  scan.range_max_m = 8.0;
  scan.ranges_m.assign(181, kNoReturn);
  scan.ranges_m[90] = range_m;
  return scan;
}

const Pose2 kTurned{0.0, 0.0, kPi};

TEST(RecentObstacles, WhatWasAheadIsBehindAfterATurn) {
  RecentObstacles recent;
  recent.see(ahead(0.0, 0.6F), {});
  recent.see(ahead(2.0, kNoReturn), kTurned);
  const std::vector<Point2> points = recent.in_base(kTurned, at(2.0));
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points.front().x(), -0.6, 1e-6);
  EXPECT_NEAR(points.front().y(), 0.0, 1e-6);
}

TEST(RecentObstacles, WhatHasGoneWhenTheLaserLooksAgainIsForgotten) {
  RecentObstacles recent;
  recent.see(ahead(0.0, 0.6F), {});
  recent.see(ahead(1.0, kNoReturn), {});
  EXPECT_TRUE(recent.in_base({}, at(1.0)).empty());
}

TEST(RecentObstacles, WhatIsFarOrOldIsForgotten) {
  RecentObstacles recent;
  recent.see(ahead(0.0, 1.6F), {});
  EXPECT_TRUE(recent.in_base({}, at(0.0)).empty()) << "beyond its reach";
  recent.see(ahead(1.0, 0.6F), {});
  EXPECT_EQ(recent.in_base(kTurned, at(301.0)).size(), 1U);
  EXPECT_TRUE(recent.in_base(kTurned, at(301.1)).empty());
  recent.see(ahead(310.0, kNoReturn), {2.5, 0.0, 0.0});
  EXPECT_TRUE(recent.in_base({}, at(1.0)).empty()) << "it lies nowhere near any more";
}

TEST(RecentObstacles, AJumpOfOdometryLeavesNothing) {
  RecentObstacles recent;
  recent.see(ahead(0.0, 0.6F), {});
  recent.forget();
  EXPECT_TRUE(recent.in_base({}, at(0.0)).empty());
}

TEST(RecentObstacles, AHundredScansOfTheSameWallAreOneWall) {
  RecentObstacles recent;
  for (int k = 0; k < 100; ++k) {
    recent.see(ahead(0.1 * k, 0.6F), {});
  }
  EXPECT_EQ(recent.in_base({}, at(9.9)).size(), 1U);
}

}  // namespace
}  // namespace seeker::app
