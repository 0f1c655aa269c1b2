#include <gtest/gtest.h>

#include "common/core/line_map.hpp"

namespace seeker {
namespace {

LineMap two_rooms() {
  LineMap map;
  map.next_id = 3;
  map.nodes = {{0, {}, RobotTime{}}, {4, {5.0, 0.0, 0.1}, RobotTime{}}};
  map.edges = {{0, 4, {5.0, 0.0, 0.1}, Matrix3::Identity() * 1e-4, false, true}};
  map.segments.resize(2);
  map.segments[0].id = 1;
  map.segments[1].id = 2;
  map.segments[1].node = 4;
  LaserScan scan;
  scan.angle_step_rad = 0.01;
  scan.range_max_m = 8.0;
  scan.ranges_m = {1.0F, kNoReturn, 2.5F};
  scan.quality = {9, 9, 0};
  map.keyframes = {pack_keyframe(scan, 4, {1.0, 2.0, 0.5})};
  return map;
}

TEST(LineMap, KeepsAScanToTwoMillimetresWithItsGaps) {
  const LaserScan scan = unpack_scan(two_rooms().keyframes.front());
  ASSERT_EQ(scan.ranges_m.size(), 3U);
  EXPECT_NEAR(scan.ranges_m[0], 1.0, kKeyframeRangeStep_m);
  EXPECT_EQ(scan.ranges_m[1], kNoReturn);
  EXPECT_GT(scan.quality[1], 0);
  EXPECT_EQ(scan.quality[2], 0) << "what the device called unusable says nothing about free space";
}

TEST(LineMap, AcceptsAConsistentMap) { EXPECT_TRUE(validate(two_rooms())); }

TEST(LineMap, RefusesWhatCannotBeAMap) {
  const auto refused = [](void (*spoil)(LineMap&)) {
    LineMap map = two_rooms();
    spoil(map);
    const Status status = validate(map);
    return !status && status.error().code == Errc::kInvalidArgument && !status.error().message.empty();
  };
  EXPECT_TRUE(refused([](LineMap& m) { m.segments[0].id = 0; }));
  EXPECT_TRUE(refused([](LineMap& m) { m.segments[0].id = 2; }));
  EXPECT_TRUE(refused([](LineMap& m) { m.next_id = 2; }));
  EXPECT_TRUE(refused([](LineMap& m) { m.segments[0].node = 3; }));
  EXPECT_TRUE(refused([](LineMap& m) { m.segments[0].covariance(0, 0) = -1.0; }));
  EXPECT_TRUE(refused([](LineMap& m) { m.segments[0].length_m = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](LineMap& m) { m.nodes[1].id = 0; }));
  EXPECT_TRUE(refused([](LineMap& m) { m.edges[0].to = 7; }));
  EXPECT_TRUE(refused([](LineMap& m) { m.edges[0].covariance(0, 2) = 5.0; }));
  EXPECT_TRUE(refused([](LineMap& m) { m.edges[0].enabled = false; })) << "nothing says where the second room is";
  EXPECT_TRUE(refused([](LineMap& m) { m.edges.clear(); }));
  EXPECT_TRUE(refused([](LineMap& m) { m.keyframes[0].ranges.clear(); }));
}

}  // namespace
}  // namespace seeker
