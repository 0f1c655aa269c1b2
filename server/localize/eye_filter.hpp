/// \file
/// The filter of the database localiser: pose of the left eye, predicted by odometry and corrected by landmarks (spec
/// S2.8, S2.9).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "server/localize/geometry.hpp"

namespace seeker::localize {

/// Mounting pose of the left eye on the robot, spec S2.8: b ahead of the centre of rotation and a to its left.
struct LeverArm {
  double ahead_m = 0.15;  ///< b
  double left_m = 0.06;   ///< a
  double yaw_rad = 0.0;   ///< yaw of the camera's z axis relative to the robot's x axis

  [[nodiscard]] Pose2 base_T_eye() const { return {ahead_m, left_m, yaw_rad}; }
  friend bool operator==(const LeverArm&, const LeverArm&) = default;
};

/// Noise of the velocities, spec S2.8: sigma = share of the velocity + a constant.
struct MotionNoise {
  double v_share = 0.05;
  double v_floor_m_s = 0.002;
  double omega_share = 0.05;
  double omega_floor_rad_s = 0.005;
  /// Heading drift: additional noise of omega for each m/s of v, rad/m, by unequal wheels.
  double drift_per_m = 0.0;
  double across_share = 0.0;     ///< lateral slip: share of v across the direction of motion
  double variance_floor = 1e-8;  ///< added to each variance, m^2 or rad^2

  friend bool operator==(const MotionNoise&, const MotionNoise&) = default;
};

/// Pose of the left eye together with the common error of all disparities (calibration), without which the pose's
/// covariance would become too small.
struct EyeBelief {
  Pose2 map_T_eye;
  double disparity_offset_px = 0.0;                      ///< measured minus true disparity
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< covariance of (x, y, theta, disparity offset)

  [[nodiscard]] Matrix3 pose_covariance() const { return covariance.topLeftCorner<3, 3>(); }
  friend bool operator==(const EyeBelief&, const EyeBelief&) = default;
};

/// Prediction by eqs (11), (13), (14): `exact` integrates the arc, otherwise Euler as printed.
void predict(EyeBelief& belief, const Twist2& velocity, double tau_s, const LeverArm& arm, const MotionNoise& noise,
             bool exact);

/// Conversion of poses and covariances between base and eye, two points of the same rigid robot.
[[nodiscard]] Pose2 base_from_eye(const Pose2& map_T_eye, const LeverArm& arm);
[[nodiscard]] Pose2 eye_from_base(const Pose2& map_T_base, const LeverArm& arm);
[[nodiscard]] Matrix3 base_covariance(const Pose2& map_T_eye, const Matrix3& eye_covariance, const LeverArm& arm);
[[nodiscard]] Matrix3 eye_covariance(const Pose2& map_T_base, const Matrix3& base_covariance, const LeverArm& arm);

/// Measurement noise in addition to that of the pixels.
struct MeasurementNoise {
  double range_floor_m = 0.01;       ///< 0.02 in spec S2.9
  double bearing_floor_rad = 0.001;  ///< 0.005 in spec S2.9
  bool landmark_covariance = true;   ///< add the covariance of the landmark's position

  friend bool operator==(const MeasurementNoise&, const MeasurementNoise&) = default;
};

/// A feature as measured by spec S2.9, with its associated landmark.
struct RangeBearing {
  double range_m = 0.0;
  double beta_rad = 0.0;  ///< bearing: pi/2 is straight ahead, larger is left
  Matrix2 covariance;     ///< covariance of (range, beta), from the noise of the pixels and the lower limits
  double range_per_disparity_m = 0.0;  ///< d range / d disparity, m/px
  Point2 landmark = Point2::Zero();    ///< position of the landmark in the frame map
  Matrix2 landmark_covariance = Matrix2::Zero();
};

[[nodiscard]] RangeBearing measure(const UncertainPoint& p_eye, double disparity_px, const MeasurementNoise& noise);

/// Difference of measurement and prediction, eq (16), with its covariance and derivative.
struct Innovation {
  Eigen::Vector2d residual;
  Matrix2 noise;                         ///< R, including the landmark's own uncertainty
  Matrix2 covariance;                    ///< covariance of the residual, including that of the belief
  Eigen::Matrix<double, 2, 4> jacobian;  ///< eq (12): derivative by (x, y, theta, disparity offset)
  double chi2 = 0.0;
};

/// The innovation of a measurement; no value where the landmark is at the eye itself.
[[nodiscard]] std::optional<Innovation> innovate(const EyeBelief& belief, const RangeBearing& seen);

/// Sequential updates by one measurement after the other, eqs (15)-(18). Returns the NIS: the sum of squared
/// innovations, 2 degrees of freedom each.
double update_sequentially(EyeBelief& belief, std::span<const RangeBearing> seen);

struct BatchParams {
  int iterations = 3;         ///< iterations of the linearisation
  double huber_sigmas = 2.5;  ///< residuals beyond it have a smaller weight

  friend bool operator==(const BatchParams&, const BatchParams&) = default;
};
/// One joint update, relinearised around the result, with the covariance in Joseph's form.
double update_together(EyeBelief& belief, std::span<const RangeBearing> seen, const BatchParams& params);

}  // namespace seeker::localize
