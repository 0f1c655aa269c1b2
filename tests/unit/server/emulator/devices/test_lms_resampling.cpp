#include <gtest/gtest.h>

#include "server/emulator/devices/lms_resampling.hpp"
#include "tests/unit/server/emulator/devices/lms_host.hpp"

namespace seeker::emulator {
namespace {

TEST(LmsResampling, TheScansOwnBeamsAreKeptAsTheyAre) {
  const LaserScan scan = numbered_scan(RobotTime());
  EXPECT_EQ(resampled(scan, {180, 50}), scan.ranges_m);
  const std::vector<float> whole = resampled(scan, {180, 100});
  ASSERT_EQ(whole.size(), 181U);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(whole[i], scan.ranges_m[2 * i]);
  }
}

TEST(LmsResampling, BetweenTwoBeamsOfOneSurfaceLiesTheirMean) {
  const std::vector<float> quarter = resampled(numbered_scan(RobotTime()), {100, 25});
  ASSERT_EQ(quarter.size(), 401U);
  EXPECT_NEAR(quarter[0], 1.080, 1e-5);
  EXPECT_NEAR(quarter[1], 1.0805, 1e-5);
  EXPECT_NEAR(quarter[399], 1.2795, 1e-5);
}

TEST(LmsResampling, AtAnEdgeTheNearerBeamIsTakenAndNoPointBetweenTheSurfaces) {
  LaserScan scan = numbered_scan(RobotTime());
  for (std::size_t i = 100; i < scan.ranges_m.size(); ++i) {
    scan.ranges_m[i] = i < 200 ? 5.0F : kNoReturn;
  }
  for (const float range_m : resampled(scan, {100, 25})) {
    EXPECT_TRUE(range_m < 1.1F || range_m == 5.0F || range_m == kNoReturn);
  }
}

TEST(LmsResampling, WhereTheScanDoesNotReachThereIsNoReturn) {
  LaserScan scan = numbered_scan(RobotTime());
  scan.angle_min_rad = 0.0;
  scan.ranges_m.resize(10);
  const std::vector<float> ranges_m = resampled(scan, {180, 50});
  EXPECT_EQ(ranges_m[179], kNoReturn);
  EXPECT_FLOAT_EQ(ranges_m[180], 1.0F);
  EXPECT_EQ(ranges_m[190], kNoReturn);
  scan.ranges_m.clear();
  EXPECT_EQ(resampled(scan, {180, 50})[180], kNoReturn);
}

}  // namespace
}  // namespace seeker::emulator
