#include <limits>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "rooms.hpp"
#include "server/slam/scan_map_tracker.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::slam {
namespace {

using testing::Pose2Near;

/// Drives a circle in the furnished room with odometry that is 5 % and 0.02 rad/m wrong.
struct Drive {
  explicit Drive(std::uint64_t seed) : rng(seed) {}

  Rng rng;
  std::vector<Wall> walls = furnished_room();
  Pose2 truth{2.5, 2.2, 0.0};
  Pose2 odom;
  double time_s = 0.0;

  void step(const Twist2& twist = {0.4, 0.28}) {
    constexpr double kTick_s = 0.1;
    const Pose2 motion = integrate(twist, kTick_s);
    truth = truth * motion;
    odom = odom * Pose2{1.05 * motion.x_m, motion.y_m, motion.theta_rad + 0.02 * motion.x_m};
    time_s += kTick_s;
  }
  LaserScan scan() { return scan_at(walls, truth, time_s, rng); }
  Status feed(PoseTracker& tracker) {
    auto predicted = tracker.predict(odom, robot_time_s(time_s));
    return predicted ? tracker.update(scan()) : predicted;
  }
};

TEST(OdometryTracker, GrowsItsCovarianceWithTheDistance) {
  OdometryTracker tracker;
  EXPECT_EQ(tracker.estimate().quality, LocalisationQuality::kUnknown);
  ASSERT_TRUE(tracker.predict({5.0, 5.0, 1.0}, robot_time_s(0.0)));
  EXPECT_EQ(tracker.estimate().map_T_base, Pose2{});
  for (int k = 1; k <= 10; ++k) {
    ASSERT_TRUE(tracker.predict(Pose2{5.0, 5.0, 1.0} * Pose2{0.1 * k, 0.0, 0.0}, robot_time_s(0.1 * k)));
  }
  const PoseEstimate estimate = tracker.estimate();
  EXPECT_THAT(estimate.map_T_base, Pose2Near(Pose2{1.0, 0.0, 0.0}, 1e-9, 1e-9));
  EXPECT_NEAR(estimate.covariance(0, 0), 0.03 * 0.03, 1e-4);
  EXPECT_NEAR(estimate.covariance(2, 2), 0.02 * 0.02, 1e-6);
  EXPECT_GT(estimate.covariance(1, 1), 0.015 * 0.015);
  EXPECT_EQ(estimate.quality, LocalisationQuality::kLocalised);
}

TEST(OdometryTracker, NamesEachFaultAndStaysConsistent) {
  OdometryTracker tracker;
  ASSERT_TRUE(tracker.predict({0.0, 0.0, 0.0}, robot_time_s(1.0)));
  EXPECT_EQ(tracker.predict({NAN, 0.0, 0.0}, robot_time_s(1.1)).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(tracker.predict({0.1, 0.0, 0.0}, robot_time_s(0.9)).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(tracker.estimate().map_T_base, Pose2{});
  EXPECT_EQ(tracker.predict({5.0, 0.0, 0.0}, robot_time_s(1.2)).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(tracker.estimate().map_T_base, Pose2{});
  EXPECT_EQ(tracker.estimate().quality, LocalisationQuality::kDegraded);
  ASSERT_TRUE(tracker.predict({5.1, 0.0, 0.0}, robot_time_s(1.3)));
  EXPECT_THAT(tracker.estimate().map_T_base, Pose2Near(Pose2{0.1, 0.0, 0.0}, 1e-9, 1e-9));
}

TEST(ScanMapTracker, StaysOnCourseWhereOdometryDrifts) {
  Drive drive(11);
  ScanMapTracker tracker({}, drive.truth);
  OdometryTracker blind({}, drive.truth);
  double worst_m = 0.0;
  for (int k = 0; k < 900; ++k) {  // 36 m, four rounds
    ASSERT_TRUE(drive.feed(tracker)) << "seed 11, step " << k;
    ASSERT_TRUE(blind.predict(drive.odom, robot_time_s(drive.time_s)));
    worst_m = std::max(worst_m, distance_m(tracker.estimate().map_T_base, drive.truth));
    drive.step();
  }
  EXPECT_LT(worst_m, 0.08);
  EXPECT_GT(distance_m(blind.estimate().map_T_base, drive.truth), 0.3);
  EXPECT_EQ(tracker.estimate().quality, LocalisationQuality::kLocalised);
  EXPECT_LT(tracker.keyframe_count(), 60U);
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(tracker.estimate().covariance);
  EXPECT_GT(eigen.eigenvalues()[0], 0.0);
}

TEST(ScanMapTracker, TypedFaultsForBadScansAndTheEstimateStays) {
  Drive drive(12);
  ScanMapTracker tracker({}, drive.truth);
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(drive.feed(tracker));
    drive.step();
  }
  const Pose2 before = tracker.estimate().map_T_base;
  LaserScan repeated = drive.scan();
  repeated.stamp = robot_time_s(0.5);
  EXPECT_EQ(tracker.update(repeated).error().code, Errc::kInvalidArgument);
  LaserScan broken = drive.scan();
  broken.ranges_m[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(tracker.update(broken).error().code, Errc::kInvalidArgument);
  LaserScan none = drive.scan();
  none.stamp = robot_time_s(drive.time_s + 0.01);
  none.ranges_m.assign(none.ranges_m.size(), kNoReturn);
  EXPECT_EQ(tracker.update(none).error().code, Errc::kNotReady);
  EXPECT_EQ(tracker.estimate().quality, LocalisationQuality::kDegraded);
  LaserScan empty = none;
  empty.ranges_m.clear();
  empty.stamp = robot_time_s(drive.time_s + 0.02);
  EXPECT_EQ(tracker.update(empty).error().code, Errc::kNotReady);
  EXPECT_EQ(tracker.estimate().map_T_base, before);
  drive.step();
  ASSERT_TRUE(drive.feed(tracker));
  EXPECT_THAT(tracker.estimate().map_T_base, Pose2Near(drive.truth, 0.08, 0.03));
  EXPECT_EQ(tracker.estimate().quality, LocalisationQuality::kLocalised);
}

TEST(ScanMapTracker, AnOdometryJumpIsReportedAndTheScanPutsItRight) {
  Drive drive(13);
  ScanMapTracker tracker({}, drive.truth);
  for (int k = 0; k < 30; ++k) {
    ASSERT_TRUE(drive.feed(tracker));
    drive.step();
  }
  drive.odom = drive.odom * Pose2{5.0, 0.0, 0.0};
  EXPECT_EQ(drive.feed(tracker).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(tracker.estimate().quality, LocalisationQuality::kDegraded);
  drive.step();
  ASSERT_TRUE(drive.feed(tracker));
  EXPECT_THAT(tracker.estimate().map_T_base, Pose2Near(drive.truth, 0.08, 0.03));
}

TEST(ScanMapTracker, SurvivesAGapOfAMetreWithWrongOdometry) {
  Drive drive(14);
  ScanMapTracker tracker({}, drive.truth);
  for (int k = 0; k < 230; ++k) {  // one round, so that the room is known
    ASSERT_TRUE(drive.feed(tracker));
    drive.step();
  }
  for (int k = 0; k < 25; ++k) {
    drive.step({0.4, 0.2});
  }
  drive.odom = drive.odom * Pose2{-0.4, 0.3, 0.3};  // the wheels slipped
  ASSERT_TRUE(drive.feed(tracker));
  drive.step();
  ASSERT_TRUE(drive.feed(tracker));
  EXPECT_LT(distance_m(tracker.estimate().map_T_base, drive.truth), 0.35);
}

TEST(ScanMapTracker, SaysDegradedInACorridor) {
  Drive drive(15);
  drive.walls = {{{-50.0, 0.0}, {80.0, 0.0}}, {{-50.0, 2.0}, {80.0, 2.0}}};
  drive.truth = {0.0, 1.0, 0.0};
  ScanMapTracker tracker({}, drive.truth);
  for (int k = 0; k < 60; ++k) {
    ASSERT_TRUE(drive.feed(tracker));
    drive.step({0.4, 0.0});
  }
  EXPECT_EQ(tracker.estimate().quality, LocalisationQuality::kDegraded);
  EXPECT_NE(tracker.estimate().cause.find("corridor"), std::string::npos);
  EXPECT_NEAR(tracker.estimate().map_T_base.y_m, 1.0, 0.05);
  EXPECT_GT(tracker.estimate().covariance(0, 0), 4.0 * tracker.estimate().covariance(1, 1));
}

TEST(ScanMapTracker, SaysLostAfterTenScansThatDoNotFit) {
  Drive drive(16);
  ScanMapParams strict;
  strict.accept_ratio = 1.01;  // no match is believed
  strict.new_space_ratio = 0.0;
  ScanMapTracker tracker(strict, drive.truth);
  for (int k = 0; k < 6; ++k) {
    ASSERT_TRUE(drive.feed(tracker));
    drive.step();
  }
  EXPECT_EQ(tracker.estimate().quality, LocalisationQuality::kDegraded);
  EXPECT_FALSE(tracker.estimate().cause.empty());
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(drive.feed(tracker));
    drive.step();
  }
  EXPECT_EQ(tracker.estimate().quality, LocalisationQuality::kLost);
  EXPECT_NE(tracker.estimate().cause.find("in a row"), std::string::npos);
  tracker.reset(drive.truth);
  ASSERT_TRUE(drive.feed(tracker));
  EXPECT_EQ(tracker.estimate().quality, LocalisationQuality::kLocalised);
}

}  // namespace
}  // namespace seeker::slam
