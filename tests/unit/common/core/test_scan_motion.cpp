#include "common/core/scan_motion.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "tests/support/box_room.hpp"

namespace seeker {
namespace {

const testing::BoxRoom kRoom;
const Twist2 kDrive{0.5, 1.0};
const RobotTime kStamp = robot_time_s(50.0);

/// The base drives an arc through the middle of a room of 6 m by 4 m, where it is at kStamp.
Pose2 room_T_base_at(RobotTime at) { return Pose2{0.2, -0.3, 0.4} * integrate(kDrive, to_seconds(at - kStamp)); }

/// A full turn of `beams` beams while the base drives, each measured at its own time.
LaserScan scan_while_driving(std::size_t beams, Duration sweep) {
  LaserScan scan;
  scan.stamp = kStamp;
  scan.sweep = sweep;
  scan.angle_step_rad = kTwoPi / static_cast<double>(beams);
  scan.angle_min_rad = -kPi + 0.5 * scan.angle_step_rad;
  scan.range_min_m = 0.1;
  scan.range_max_m = 12.0;
  scan.base_T_laser = {0.1, 0.05, 2.0};
  scan.ranges_m.resize(beams);
  scan.quality.assign(beams, 47);
  for (std::size_t i = 0; i < beams; ++i) {
    const Pose2 room_T_laser = room_T_base_at(scan.time_of(i)) * scan.base_T_laser;
    scan.ranges_m[i] = static_cast<float>(kRoom.range_m(room_T_laser * Pose2{0.0, 0.0, scan.angle_rad(i)}));
  }
  return scan;
}

/// The largest distance of an end point from the walls, the scan taken to be measured at its stamp.
double worst_m(const LaserScan& scan) {
  double worst_m = 0.0;
  for (const Point2& p_base : points_in_base(scan)) {
    worst_m = std::max(worst_m, kRoom.distance_from_walls_m(room_T_base_at(scan.stamp) * p_base));
  }
  return worst_m;
}

constexpr std::size_t kBeams = 720;
constexpr Duration kTurn = -std::chrono::milliseconds(181);  // a scanner that turns clockwise at 5.5 Hz

TEST(ScanMotion, AScanTakenWhileDrivingFitsTheRoomAfterCorrectionAndNotBefore) {
  const LaserScan scan = scan_while_driving(kBeams, kTurn);
  // Half a turn takes 0.09 s, in which the base turns 0.09 rad: up to 0.3 m at the far wall.
  EXPECT_GT(worst_m(scan), 0.15);
  // A cell has the beam nearest to it, at most one step away: the end point is off by the step times the range.
  const double farthest_m = *std::max_element(scan.ranges_m.begin(), scan.ranges_m.end());
  const LaserScan corrected = corrected_for_motion(scan, room_T_base_at);
  EXPECT_LT(worst_m(corrected), farthest_m * scan.angle_step_rad);
  EXPECT_EQ(corrected.sweep, Duration::zero());
  EXPECT_EQ(corrected.stamp, scan.stamp);
}

TEST(ScanMotion, TheSignOfTheSweepTellsWhichBeamWasFirst) {
  LaserScan scan = scan_while_driving(kBeams, kTurn);
  EXPECT_GT(scan.time_of(0), scan.time_of(kBeams - 1));
  scan.sweep = -scan.sweep;
  EXPECT_GT(worst_m(corrected_for_motion(scan, room_T_base_at)), 0.3) << "twice as wrong";
}

TEST(ScanMotion, ARotationLeavesNoCellsEmptyInEitherDirection) {
  for (const Duration sweep : {kTurn, -kTurn}) {
    const LaserScan corrected = corrected_for_motion(scan_while_driving(kBeams, sweep), room_T_base_at);
    // Where the two ends of the turn meet, the rotation leaves a wedge that no beam has seen, or saw twice.
    const auto empty = std::count(corrected.ranges_m.begin(), corrected.ranges_m.end(), kNoReturn);
    const double wedge_steps = std::abs(to_seconds(sweep)) * kDrive.omega_rad_s / corrected.angle_step_rad;
    EXPECT_LE(static_cast<double>(empty), wedge_steps + 4.0);
  }
}

TEST(ScanMotion, NoReturnStaysNoReturnAndTurnsWithTheBase) {
  LaserScan scan;
  scan.stamp = kStamp;
  scan.sweep = std::chrono::milliseconds(100);
  scan.angle_min_rad = -1.0;
  scan.angle_step_rad = 0.1;
  scan.range_max_m = 8.0;
  scan.ranges_m.assign(21, 2.0F);
  scan.ranges_m[0] = kNoReturn;
  // The base turns 0.2 rad in half the sweep: the first beam pointed two steps further right than it says.
  const auto turning = [](RobotTime at) { return Pose2{0.0, 0.0, 4.0 * to_seconds(at - kStamp)}; };
  const LaserScan corrected = corrected_for_motion(scan, turning);
  EXPECT_EQ(corrected.ranges_m[0], 2.0F) << "the beam that lies there now";
  EXPECT_EQ(std::count(corrected.ranges_m.begin(), corrected.ranges_m.end(), kNoReturn), 0);
  scan.ranges_m.assign(21, kNoReturn);
  EXPECT_EQ(corrected_for_motion(scan, turning).ranges_m, scan.ranges_m);
}

TEST(ScanMotion, TheMiddleBeamOfAnOddNumberKeepsItsValue) {
  const LaserScan scan = scan_while_driving(721, kTurn);
  EXPECT_NEAR(corrected_for_motion(scan, room_T_base_at).ranges_m[360], scan.ranges_m[360], 1e-5);
}

RC_GTEST_PROP(ScanMotion, AScanWithoutASweepComesBackBitForBit, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  LaserScan scan = scan_while_driving(1 + rng.below(400), Duration::zero());
  for (float& range_m : scan.ranges_m) {
    range_m = rng.below(4) == 0 ? kNoReturn : static_cast<float>(rng.uniform(0.0, 20.0));
  }
  RC_ASSERT(corrected_for_motion(scan, [](RobotTime) -> Pose2 { std::abort(); }) == scan);
}

RC_GTEST_PROP(ScanMotion, ABaseThatStandsChangesNothingButTheSweep, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  LaserScan scan = scan_while_driving(2 + rng.below(400), kTurn);
  const Pose2 odom_T_base{rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0), rng.uniform(-kPi, kPi)};
  const LaserScan corrected = corrected_for_motion(scan, [&](RobotTime) { return odom_T_base; });
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    RC_ASSERT(std::abs(corrected.ranges_m[i] - scan.ranges_m[i]) < 1e-4F * scan.ranges_m[i]);
  }
  RC_ASSERT(corrected.quality == scan.quality);
}

RC_GTEST_PROP(ScanMotion, WhateverIsMeasuredAndDrivenTheResultIsAValidScan, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  LaserScan scan = scan_while_driving(1 + rng.below(400), seconds(rng.uniform(-10.0, 10.0)));
  scan.angle_min_rad = rng.uniform(-10.0, 10.0);
  scan.angle_step_rad = rng.uniform(-0.2, 0.2) + 1e-9;
  for (float& range_m : scan.ranges_m) {
    range_m = rng.below(4) == 0 ? kNoReturn : static_cast<float>(rng.uniform(0.0, 1e6));
  }
  const Twist2 twist{rng.uniform(-100.0, 100.0), rng.uniform(-50.0, 50.0)};
  const LaserScan corrected =
      corrected_for_motion(scan, [&](RobotTime at) { return integrate(twist, to_seconds(at - kStamp)); });
  RC_ASSERT(validate(corrected).has_value());
  RC_ASSERT(corrected.ranges_m.size() == scan.ranges_m.size());
}

}  // namespace
}  // namespace seeker
