/// \file
/// Systematic errors of the odometry, estimated while driving: wheels with a wrong or unequal diameter, a wrong track
/// width, and a scanner that is not mounted exactly at its configured pose.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/core/pose2.hpp"

namespace seeker::slam {

/// Prior standard deviations of the error factors. The factors change slowly, since floors and tyres change.
struct OdometryBiasParams {
  double scale_sigma = 0.05;            ///< standard deviation of the scale error of the odometry, per metre driven
  double drift_sigma_rad_per_m = 0.05;  ///< standard deviation of the heading drift, per metre driven forwards
  double rotation_scale_sigma = 0.05;   ///< standard deviation of the scale error of rotations, per radian rotated
  /// Standard deviation of the lateral displacement (to the left), per metre driven forwards.
  double skew_sigma = 0.02;
  /// Standard deviation of the lateral displacement (to the left), per radian rotated.
  double lever_sigma_m = 0.05;
  double drift_share = 0.02;       ///< random walk of the factors: share of these deviations per root of a metre driven
  double match_sigma_m = 0.02;     ///< standard deviation of the displacement between two matches
  double match_sigma_rad = 0.006;  ///< standard deviation of the rotation between two matches
  double gate = 6.635;             ///< chi-square of 1 dof, 99 %: motions with wheel slip beyond it are not used
};

/// Parameters of a calibrated robot, whose odometry has no systematic error to estimate.
inline constexpr OdometryBiasParams kCalibratedOdometry{.scale_sigma = 0.0,
                                                        .drift_sigma_rad_per_m = 0.0,
                                                        .rotation_scale_sigma = 0.0,
                                                        .skew_sigma = 0.0,
                                                        .lever_sigma_m = 0.0};

/// Estimates five error factors in a Kalman filter whose measurements are motions between two scan matches. A map
/// filter that assumes random errors only lags behind a robot with a constant heading drift, and distorts its map
/// accordingly.
class OdometryBias {
 public:
  explicit OdometryBias(const OdometryBiasParams& params = {});

  /// The motion (final pose in the frame of the initial one) corrected for the estimated errors.
  [[nodiscard]] Pose2 corrected(const Pose2& increment) const;
  /// Covariance of the corrected motion (x, y, theta, in the frame of its initial pose) from the uncertainty of the
  /// factors alone. Their errors are correlated from one motion to the next. The errors of consecutive matches are
  /// correlated, too, and leave the factors more certain than a filter with independent errors says, which compensates
  /// for this (experiment R2, uneven wheels).
  [[nodiscard]] Matrix3 covariance_of(const Pose2& increment) const;
  /// Adds a motion as reported by the odometry, with its stated covariance.
  void note_motion(const Pose2& increment, const Matrix3& covariance);
  /// Adds the pose at which a scan match found the robot after the motions so far, in a frame that is the same from
  /// match to match. `unseen` is the unit vector in that frame along which the match does not constrain the pose, as in
  /// a corridor.
  void note_match(const Pose2& frame_T_base, const std::optional<Point2>& unseen);
  /// Excludes the motion to the next match, which is not compared with the last one.
  void forget_match() { last_match_.reset(); }
  /// Changes the frame of the matches.
  void change_frame(const Pose2& new_T_old);

  [[nodiscard]] double scale_error() const { return factors_[kScale]; }
  [[nodiscard]] double drift_rad_per_m() const { return factors_[kDrift]; }
  [[nodiscard]] double rotation_scale_error() const { return factors_[kRotation]; }
  [[nodiscard]] double skew() const { return factors_[kSkew]; }
  [[nodiscard]] double lever_m() const { return factors_[kLever]; }

 private:
  enum Factor : Eigen::Index { kScale, kDrift, kRotation, kSkew, kLever, kFactors };
  using Vector = Eigen::Matrix<double, kFactors, 1>;

  void learn(const Pose2& matched, const Point2& unseen);
  /// Applies one scalar measurement: `innovation` is the residual after the prediction row * factors.
  void correct(const Vector& row, double innovation, double variance);

  OdometryBiasParams params_;
  Vector sigmas_;
  Vector factors_ = Vector::Zero();
  Eigen::Matrix<double, kFactors, kFactors> covariance_;
  std::optional<Pose2> last_match_;
  UncertainPose since_match_;  ///< motion since the last match by odometry
};

}  // namespace seeker::slam
