#include "common/core/scan_merge.hpp"

#include <array>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "tests/support/box_room.hpp"

namespace seeker {
namespace {

Pose2 stands_still(RobotTime /*stamp*/) { return {}; }

/// A scan of a scanner of 180 degrees in steps of half a degree, at the pose of the base in the room.
LaserScan half_circle(const testing::BoxRoom& room, const Pose2& room_T_base, const Pose2& base_T_laser,
                      RobotTime stamp = {}) {
  LaserScan scan;
  scan.stamp = stamp;
  scan.angle_min_rad = -kPi / 2.0;
  scan.angle_step_rad = deg_to_rad(0.5);
  scan.range_max_m = 20.0;
  scan.base_T_laser = base_T_laser;
  scan.ranges_m.reserve(361);
  for (std::size_t beam = 0; beam < 361; ++beam) {
    const Pose2 room_T_beam = room_T_base * base_T_laser * Pose2{0.0, 0.0, scan.angle_rad(beam)};
    scan.ranges_m.push_back(static_cast<float>(room.range_m(room_T_beam)));
  }
  return scan;
}

const Pose2 kFront{0.2, 0.0, 0.0};
const Pose2 kBack{-0.25, 0.05, kPi};

TEST(ScanMerge, SeesTheWholeRoomFromTheBaseWithOneScannerAheadAndOneBehind) {
  const testing::BoxRoom room;
  const Pose2 room_T_base{0.4, -0.3, 0.5};
  const std::array scans{half_circle(room, room_T_base, kFront), half_circle(room, room_T_base, kBack)};
  const LaserScan merged = merged_scan(scans, stands_still);
  ASSERT_EQ(merged.ranges_m.size(), 720U);
  EXPECT_EQ(merged.base_T_laser, Pose2{});
  ASSERT_TRUE(validate(merged));
  std::size_t seen = 0;
  for (std::size_t beam = 0; beam < merged.ranges_m.size(); ++beam) {
    if (merged.quality[beam] == 0) {
      EXPECT_EQ(merged.ranges_m[beam], kNoReturn);
      continue;
    }
    ++seen;
    const double angle_rad = merged.angle_rad(beam);
    const double range_m = merged.ranges_m[beam];
    const Point2 p_room = room_T_base * Point2(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
    EXPECT_LT(room.distance_from_walls_m(p_room), 0.02) << beam;
  }
  EXPECT_GT(seen, 660U);  // all but what lies beside the base, between the two
}

TEST(ScanMerge, LeavesDirectionsThatNoScannerLooksInUnusable) {
  const testing::BoxRoom room;
  const std::array scans{half_circle(room, {}, kFront)};
  const LaserScan merged = merged_scan(scans, stands_still);
  EXPECT_EQ(merged.quality[0], 0);    // behind
  EXPECT_EQ(merged.quality[360], 1);  // ahead
  EXPECT_NEAR(merged.ranges_m[360], 3.0, 0.01);
}

TEST(ScanMerge, KeepsTheNearestReturnWhicheverScannerSawIt) {
  LaserScan far;
  far.angle_step_rad = 0.1;
  far.range_max_m = 8.0;
  far.ranges_m = {4.0F};
  LaserScan near = far;
  near.ranges_m = {2.0F};
  LaserScan nothing = far;
  nothing.ranges_m = {kNoReturn};
  const std::array ways{std::array{far, near, nothing}, std::array{nothing, far, near}, std::array{near, nothing, far}};
  for (const auto& scans : ways) {
    const LaserScan merged = merged_scan(scans, stands_still);
    EXPECT_FLOAT_EQ(merged.ranges_m[360], 2.0F);
  }
  const LaserScan free = merged_scan(std::array{nothing}, stands_still);
  EXPECT_EQ(free.ranges_m[360], kNoReturn);
  EXPECT_EQ(free.quality[360], 1);
}

TEST(ScanMerge, DoesNotLetUnusableBeamsSpeak) {
  LaserScan scan;
  scan.angle_step_rad = 0.1;
  scan.range_min_m = 0.5;
  scan.range_max_m = 8.0;
  scan.ranges_m = {1.0F, kNoReturn, 0.1F};
  scan.quality = {0, 0, 9};
  const LaserScan merged = merged_scan(std::array{scan}, stands_still);
  for (const std::uint8_t quality : merged.quality) {
    EXPECT_EQ(quality, 0);
  }
}

TEST(ScanMerge, TakesTheMotionBetweenTheScansOut) {
  const testing::BoxRoom room;
  const auto room_T_base_at = [](RobotTime stamp) { return integrate({0.5, 0.8}, to_seconds(stamp)); };
  const RobotTime now = robot_time_s(1.0);
  const RobotTime before = robot_time_s(0.7);
  const std::array scans{half_circle(room, room_T_base_at(now), kFront, now),
                         half_circle(room, room_T_base_at(before), kBack, before)};
  const LaserScan merged = merged_scan(scans, room_T_base_at);
  EXPECT_EQ(merged.stamp, now);
  for (std::size_t beam = 0; beam < merged.ranges_m.size(); ++beam) {
    if (merged.quality[beam] > 0) {
      const double angle_rad = merged.angle_rad(beam);
      const double range_m = merged.ranges_m[beam];
      const Point2 p_base(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
      EXPECT_LT(room.distance_from_walls_m(room_T_base_at(now) * p_base), 0.03) << beam;
    }
  }
}

TEST(ScanMerge, DoesNotBridgeAnEdge) {
  LaserScan scan;
  scan.angle_min_rad = 0.0;
  scan.angle_step_rad = deg_to_rad(2.0);
  scan.range_max_m = 8.0;
  scan.ranges_m = {2.0F, 2.0F, 4.0F};
  const LaserScan merged = merged_scan(std::array{scan}, stands_still);
  EXPECT_EQ(merged.quality[361], 1);  // between the first two: one surface
  EXPECT_NEAR(merged.ranges_m[361], 2.0, 0.01);
  EXPECT_EQ(merged.quality[365], 0);  // between the second and the third: an edge
}

}  // namespace
}  // namespace seeker
