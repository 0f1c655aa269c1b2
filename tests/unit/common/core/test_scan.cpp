#include "common/core/scan.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "tests/support/matchers.hpp"

namespace seeker {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::Point2Near;

LaserScan scan_of(std::vector<float> ranges_m) {
  LaserScan scan;
  scan.angle_min_rad = -kPi / 2.0;
  scan.angle_step_rad = kPi / 2.0;
  scan.range_min_m = 0.1;
  scan.range_max_m = 8.0;
  scan.ranges_m = std::move(ranges_m);
  return scan;
}

TEST(LaserScan, BeamsPointFromRightToLeft) {
  const LaserScan scan = scan_of({1.0F, 2.0F, 3.0F});
  EXPECT_THAT(points_in_base(scan), ElementsAre(Point2Near(Point2(0.0, -1.0), 1e-6), Point2Near(Point2(2.0, 0.0), 1e-6),
                                                Point2Near(Point2(0.0, 3.0), 1e-6)));
}

TEST(LaserScan, PointsFollowTheMountingOfTheLaser) {
  LaserScan scan = scan_of({kNoReturn, 2.0F, kNoReturn});
  scan.base_T_laser = {0.5, 0.25, kPi / 2.0};
  EXPECT_THAT(points_in_base(scan), ElementsAre(Point2Near(Point2(0.5, 2.25), 1e-6)));
}

TEST(LaserScan, NoReturnTooNearAndTooFarGiveNoPoint) {
  EXPECT_TRUE(points_in_base(scan_of({kNoReturn, 0.05F, 9.0F})).empty());
  EXPECT_EQ(points_in_base(scan_of({0.1F, 8.0F})).size(), 2U);
}

TEST(LaserScan, NoReturnIsValidButNanNegativeAndMissingStepAreNot) {
  EXPECT_TRUE(validate(scan_of({kNoReturn, 1.0F})));
  const Status nan = validate(scan_of({1.0F, std::numeric_limits<float>::quiet_NaN()}));
  ASSERT_FALSE(nan);
  EXPECT_THAT(nan.error().message, HasSubstr("beam 1"));
  EXPECT_FALSE(validate(scan_of({-0.5F})));
  LaserScan still = scan_of({1.0F});
  still.angle_step_rad = 0.0;
  EXPECT_EQ(validate(still).error().code, Errc::kInvalidArgument);
}

TEST(LaserScan, BeamsOfASweepAreMeasuredEvenlyAroundTheStamp) {
  LaserScan scan = scan_of({1.0F, 2.0F, 3.0F});
  scan.stamp = robot_time_s(10.0);
  EXPECT_EQ(scan.time_of(0), scan.stamp) << "all at once";
  scan.sweep = -std::chrono::milliseconds(100);
  EXPECT_EQ(scan.time_of(0), robot_time_s(10.05)) << "measured last";
  EXPECT_EQ(scan.time_of(1), scan.stamp);
  EXPECT_EQ(scan.time_of(2), robot_time_s(9.95));
  EXPECT_TRUE(validate(scan));
  scan.sweep = -kMaxSweep - Duration(1);
  EXPECT_EQ(validate(scan).error().code, Errc::kInvalidArgument);
}

TEST(LaserScan, TooManyBeamsAndWrongNumberOfQualitiesAreRefused) {
  EXPECT_TRUE(validate(scan_of(std::vector<float>(kMaxScanBeams, 1.0F))));
  EXPECT_EQ(validate(scan_of(std::vector<float>(kMaxScanBeams + 1, 1.0F))).error().code, Errc::kTooLarge);
  LaserScan scan = scan_of({1.0F, 2.0F});
  scan.quality = {1};
  EXPECT_EQ(validate(scan).error().code, Errc::kInvalidArgument);
}

TEST(SonarScan, NanNamesTheTransducer) {
  SonarScan scan;
  scan.readings = {{{}, 1.0F}, {{}, kNoReturn}};
  EXPECT_TRUE(validate(scan));
  scan.readings.push_back({{}, std::numeric_limits<float>::quiet_NaN()});
  EXPECT_THAT(validate(scan).error().message, HasSubstr("sonar 2"));
}

}  // namespace
}  // namespace seeker
