#include "server/slam/odometry_bias.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"

namespace seeker::slam {
namespace {

const Matrix3 kStated = Eigen::Vector3d(1e-5, 1e-5, 1e-5).asDiagonal();

/// A robot whose odometry measures distances 4 % short, misses 0.05 rad a metre and a twentieth of its rotations, and
/// whose scanner sits turned by 1.1 degrees and 5 cm in front of where it is said to be.
Pose2 truly(const Pose2& reported) {
  const double rotation_rad = 1.05 * reported.theta_rad + 0.05 * reported.x_m;
  const Pose2 half{0.0, 0.0, 0.5 * (rotation_rad - reported.theta_rad)};
  const Point2 along = half * Point2(1.04 * reported.translation());
  return {along.x(), along.y() + 0.02 * reported.x_m + 0.05 * std::sin(rotation_rad), rotation_rad};
}

/// Drives so many steps of 0.2 m along a winding path.
void drive(OdometryBias& bias, int steps, const std::optional<Point2>& unseen_base = std::nullopt) {
  Rng rng(3);
  Pose2 pose;
  bias.note_match(pose, std::nullopt);
  for (int k = 0; k < steps; ++k) {
    const Pose2 reported{0.2, 0.0, 0.3 * std::sin(0.2 * k)};
    bias.note_motion(reported, kStated);
    pose = pose * truly(reported) * Pose2{rng.normal(0.003), rng.normal(0.003), rng.normal(0.002)};
    const Pose2 heading{0.0, 0.0, pose.theta_rad};
    bias.note_match(pose, unseen_base ? std::optional<Point2>(heading * *unseen_base) : std::nullopt);
  }
}

TEST(OdometryBias, LeavesTheOdometryAsItIsBeforeAnyEstimate) {
  const OdometryBias bias;
  const Pose2 reported{0.3, 0.01, 0.2};
  EXPECT_LT(offset_of(bias.corrected(reported), reported).norm(), 1e-12);
}

TEST(OdometryBias, LearnsWhatTheWheelsAndTheMountAreOffBy) {
  OdometryBias bias;
  drive(bias, 300);
  EXPECT_NEAR(bias.scale_error(), 0.04, 0.01);
  EXPECT_NEAR(bias.drift_rad_per_m(), 0.05, 0.01);
  EXPECT_NEAR(bias.rotation_scale_error(), 0.05, 0.02);
  EXPECT_NEAR(bias.skew(), 0.02, 0.01);
  EXPECT_NEAR(bias.lever_m(), 0.05, 0.02);
  const Pose2 reported{0.2, 0.0, 0.1};
  const Eigen::Vector3d off = offset_of(bias.corrected(reported), truly(reported));
  EXPECT_LT(off.head<2>().norm(), 0.003);
  EXPECT_LT(std::abs(off[2]), 0.003);
}

TEST(OdometryBias, SaysHowUncertainAMotionIsBeforeAndAfterTheEstimate) {
  OdometryBias bias;
  const Pose2 metre{1.0, 0.0, 0.0};
  const Matrix3 before = bias.covariance_of(metre);
  EXPECT_NEAR(before(0, 0), 0.05 * 0.05, 1e-9) << "the scale error";
  EXPECT_NEAR(before(1, 1), 0.02 * 0.02 + 0.025 * 0.025, 1e-9) << "the mount, and half of the drift";
  EXPECT_NEAR(before(2, 2), 0.05 * 0.05, 1e-9) << "the heading drift";
  EXPECT_NEAR(bias.covariance_of({0.0, 0.0, 0.5})(2, 2), 0.025 * 0.025, 1e-9) << "a rotation on the spot";
  drive(bias, 300);
  EXPECT_LT(bias.covariance_of(metre).trace(), 0.1 * before.trace());
  EXPECT_EQ(OdometryBias(kCalibratedOdometry).covariance_of(metre), Matrix3::Zero());
}

TEST(OdometryBias, EstimatesTheHeadingDriftButNoScaleErrorInACorridor) {
  OdometryBias bias;
  drive(bias, 300, Point2::UnitX());
  EXPECT_DOUBLE_EQ(bias.scale_error(), 0.0);
  EXPECT_NEAR(bias.drift_rad_per_m(), 0.05, 0.01);
}

TEST(OdometryBias, LearnsNothingFromASlip) {
  OdometryBias bias;
  drive(bias, 300);
  const double drift = bias.drift_rad_per_m();
  bias.note_match({}, std::nullopt);
  bias.note_motion({0.2, 0.0, 0.0}, kStated);
  bias.note_match({0.2, 0.0, 0.5}, std::nullopt);
  EXPECT_NEAR(bias.drift_rad_per_m(), drift, 1e-3);
}

TEST(OdometryBias, ComparesNoMatchesAcrossOneThatFailed) {
  OdometryBias bias;
  bias.note_match({}, std::nullopt);
  bias.note_motion({0.2, 0.0, 0.0}, kStated);
  bias.forget_match();
  bias.note_match({0.25, 0.0, 0.01}, std::nullopt);
  EXPECT_DOUBLE_EQ(bias.scale_error(), 0.0);
  EXPECT_DOUBLE_EQ(bias.drift_rad_per_m(), 0.0);
}

TEST(OdometryBias, LearnsTheSameWhereTheFrameOfTheMatchesChanges) {
  OdometryBias plain;
  OdometryBias changed;
  const Pose2 new_T_old{3.0, -2.0, 1.2};
  for (OdometryBias* bias : {&plain, &changed}) {
    bias->note_match({1.0, 0.5, 0.3}, std::nullopt);
    bias->note_motion({0.2, 0.0, 0.0}, kStated);
  }
  changed.change_frame(new_T_old);
  const Pose2 found = Pose2{1.0, 0.5, 0.3} * Pose2{0.206, 0.002, 0.006};
  plain.note_match(found, std::nullopt);
  changed.note_match(new_T_old * found, std::nullopt);
  EXPECT_GT(plain.scale_error(), 0.0);
  EXPECT_NEAR(changed.scale_error(), plain.scale_error(), 1e-9);
  EXPECT_NEAR(changed.drift_rad_per_m(), plain.drift_rad_per_m(), 1e-9);
}

}  // namespace
}  // namespace seeker::slam
