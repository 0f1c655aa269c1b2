/// \file
/// The filter of the database localiser: pose of the left eye, moved by odometry, corrected by landmarks (spec S2.8,
/// S2.9).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "server/localize/geometry.hpp"

namespace seeker::localize {

/// Where the left eye sits on the robot, spec S2.8: b ahead of the centre of rotation and a to its left.
struct LeverArm {
  double ahead_m = 0.15;  ///< b
  double left_m = 0.06;   ///< a
  double yaw_rad = 0.0;   ///< of the camera's z axis against the robot's x axis

  [[nodiscard]] Pose2 base_T_eye() const { return {ahead_m, left_m, yaw_rad}; }
  friend bool operator==(const LeverArm&, const LeverArm&) = default;
};

/// Noise of the velocities, spec S2.8: sigma = share of the velocity + a little.
struct MotionNoise {
  double v_share = 0.05;
  double v_floor_m_s = 0.002;
  double omega_share = 0.05;
  double omega_floor_rad_s = 0.005;
  double turn_per_m = 0.0;       ///< further noise of omega for each m/s of v, rad/m: unequal wheels
  double across_share = 0.0;     ///< of v, sideways: slip
  double variance_floor = 1e-8;  ///< added to each variance, m^2 or rad^2

  friend bool operator==(const MotionNoise&, const MotionNoise&) = default;
};

/// Pose of the left eye, and beside it the error that all disparities share (calibration): what the pose's covariance
/// must know of so as not to become too sure.
struct EyeBelief {
  Pose2 map_T_eye;
  double disparity_offset_px = 0.0;                      ///< measured minus true
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< of (x, y, theta, disparity offset)

  [[nodiscard]] Matrix3 pose_covariance() const { return covariance.topLeftCorner<3, 3>(); }
  friend bool operator==(const EyeBelief&, const EyeBelief&) = default;
};

/// Eqs (11), (13), (14): `exact` integrates the arc, else Euler as printed.
void predict(EyeBelief& belief, const Twist2& velocity, double tau_s, const LeverArm& arm, const MotionNoise& noise,
             bool exact);

/// Covariances of base and eye belong together: the same robot, another point of it.
[[nodiscard]] Pose2 base_from_eye(const Pose2& map_T_eye, const LeverArm& arm);
[[nodiscard]] Pose2 eye_from_base(const Pose2& map_T_base, const LeverArm& arm);
[[nodiscard]] Matrix3 base_covariance(const Pose2& map_T_eye, const Matrix3& eye_covariance, const LeverArm& arm);
[[nodiscard]] Matrix3 eye_covariance(const Pose2& map_T_base, const Matrix3& base_covariance, const LeverArm& arm);

/// Noise of measurements beside that of pixels.
struct MeasurementNoise {
  double range_floor_m = 0.01;       ///< 0.02 in spec S2.9
  double bearing_floor_rad = 0.001;  ///< 0.005 in spec S2.9
  bool landmark_covariance = true;   ///< add that of the landmark's place

  friend bool operator==(const MeasurementNoise&, const MeasurementNoise&) = default;
};

/// A feature as spec S2.9 measures it, with the landmark it was taken for.
struct RangeBearing {
  double range_m = 0.0;
  double beta_rad = 0.0;               ///< pi/2 is straight ahead, more is left
  Matrix2 covariance;                  ///< of (range, beta), from pixels and floors
  double range_per_disparity_m = 0.0;  ///< d range / d disparity, m/px
  Point2 landmark = Point2::Zero();    ///< where it stands, in the frame map
  Matrix2 landmark_covariance = Matrix2::Zero();
};

[[nodiscard]] RangeBearing measure(const UncertainPoint& p_eye, double disparity_px, const MeasurementNoise& noise);

/// Difference of measurement and prediction, eq (16), with its covariance and derivative.
struct Innovation {
  Eigen::Vector2d residual;
  Matrix2 noise;                         ///< R, the landmark's own uncertainty included
  Matrix2 covariance;                    ///< of the residual: what the belief adds included
  Eigen::Matrix<double, 2, 4> jacobian;  ///< eq (12) by (x, y, theta, disparity offset)
  double chi2 = 0.0;
};

/// Nothing where the landmark stands in the eye itself.
[[nodiscard]] std::optional<Innovation> innovate(const EyeBelief& belief, const RangeBearing& seen);

/// One measurement after the other, eqs (15)-(18). NIS: the sum of squared innovations, 2 degrees of freedom each.
double update_in_turn(EyeBelief& belief, std::span<const RangeBearing> seen);

struct BatchParams {
  int iterations = 3;         ///< of the linearisation
  double huber_sigmas = 2.5;  ///< residuals beyond weigh less

  friend bool operator==(const BatchParams&, const BatchParams&) = default;
};
/// All at once, linearised anew around the result, covariance in Joseph's form.
double update_together(EyeBelief& belief, std::span<const RangeBearing> seen, const BatchParams& params);

}  // namespace seeker::localize
