/// \file
/// What a robot's odometry is off by all the time, learnt while it drives: wheels that are not the size they are said
/// to be, nor equal, a track that is not as wide, a scanner that is not mounted quite where and as it is said to be.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "common/core/pose2.hpp"

namespace seeker::slam {

/// Deviations of the factors before anything was driven. They drift, since floors and tyres change.
struct OdometryBiasParams {
  double way_sigma = 0.05;             ///< metres too few for each metre told
  double bend_sigma_rad_per_m = 0.05;  ///< turned for each metre forwards without being told
  double turn_sigma = 0.05;            ///< radians too few for each radian told
  double skew_sigma = 0.02;            ///< metres to the left for each metre forwards
  double lever_sigma_m = 0.05;         ///< metres to the left for each radian turned
  double drift_share = 0.02;           ///< of these deviations, for the root of each metre driven
  double match_sigma_m = 0.02;         ///< of the motion between two matches
  double match_sigma_rad = 0.006;
  double gate = 6.635;  ///< chi-square of 1 dof, 99 %: wheels that slipped teach nothing
};

/// Of wheels and a mount that are what they are said to be: there is nothing to learn.
inline constexpr OdometryBiasParams kCalibratedOdometry{
    .way_sigma = 0.0, .bend_sigma_rad_per_m = 0.0, .turn_sigma = 0.0, .skew_sigma = 0.0, .lever_sigma_m = 0.0};

/// Five factors in a Kalman filter whose measurements are motions between two scan matches. A filter of the map that
/// is told of random errors only follows a robot that always bends one way from behind, and bends its map with it.
class OdometryBias {
 public:
  explicit OdometryBias(const OdometryBiasParams& params = {});

  /// The motion (pose of its end in the frame of its beginning) without what it is known to be off by.
  [[nodiscard]] Pose2 corrected(const Pose2& increment) const;
  /// Covariance of the corrected motion (x, y, theta, in the frame of its beginning) from what the factors are
  /// uncertain by alone. They err alike from one motion to the next; that matches beside each other do so too, and
  /// leave the factors better known than a filter of independent ones says, makes up for it (experiment R2, uneven
  /// wheels).
  [[nodiscard]] Matrix3 covariance_of(const Pose2& increment) const;
  /// A motion by odometry, as told, with its stated covariance.
  void note_motion(const Pose2& increment, const Matrix3& covariance);
  /// Where a scan match found the robot after the motions so far, in a frame that is the same from match to match.
  /// `unseen`: unit vector in that frame along which the match says nothing, as in a corridor.
  void note_match(const Pose2& frame_T_base, const std::optional<Point2>& unseen);
  /// The next match is not compared with the last one.
  void forget_match() { last_match_.reset(); }
  /// The frame of the matches is another one from now on.
  void change_frame(const Pose2& new_T_old);

  [[nodiscard]] double way() const { return factors_[kWay]; }
  [[nodiscard]] double bend_rad_per_m() const { return factors_[kBend]; }
  [[nodiscard]] double turn() const { return factors_[kTurn]; }
  [[nodiscard]] double skew() const { return factors_[kSkew]; }
  [[nodiscard]] double lever_m() const { return factors_[kLever]; }

 private:
  enum Factor : Eigen::Index { kWay, kBend, kTurn, kSkew, kLever, kFactors };
  using Vector = Eigen::Matrix<double, kFactors, 1>;

  void learn(const Pose2& matched, const Point2& unseen);
  /// One scalar measurement: `innovation` beyond what row * factors says already.
  void correct(const Vector& row, double innovation, double variance);

  OdometryBiasParams params_;
  Vector sigmas_;
  Vector factors_ = Vector::Zero();
  Eigen::Matrix<double, kFactors, kFactors> covariance_;
  std::optional<Pose2> last_match_;
  UncertainPose since_match_;  ///< by odometry
};

}  // namespace seeker::slam
