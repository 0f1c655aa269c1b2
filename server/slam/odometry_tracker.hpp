/// \file
/// Dead reckoning with its growing covariance: the paper's estimator, and the prediction step of every other one.
#pragma once

#include <optional>

#include "server/slam/pose_tracker.hpp"

namespace seeker::slam {

/// Odometry noise (spec S1.3, eq (11) and C_u): variances grow with the path length and the rotation.
struct OdometryParams {
  double along_sigma_m_per_sqrt_m = 0.03;
  double across_sigma_m_per_sqrt_m = 0.015;
  double theta_sigma_rad_per_sqrt_m = 0.02;
  double theta_sigma_rad_per_sqrt_rad = 0.03;
  double jump_m = 0.5;  ///< an increment is a jump beyond jump_m + jump_speed_m_s * dt
  double jump_speed_m_s = 2.0;
  double jump_rad = 0.8;  ///< the same for the rotation
  double jump_speed_rad_s = 4.0;
  double jump_sigma_m = 0.5;    ///< standard deviation of the position after an increment was dropped as a jump
  double jump_sigma_rad = 0.3;  ///< standard deviation of the heading after a jump
};

/// Covariance of one increment: of d in increment (+) d, that is in the frame of the new pose.
[[nodiscard]] Matrix3 increment_covariance(const Pose2& increment, const OdometryParams& params);

class OdometryTracker final : public PoseTracker {
 public:
  explicit OdometryTracker(const OdometryParams& params = {}, const Pose2& map_T_base = {});

  [[nodiscard]] Status predict(const Pose2& odom_T_base, RobotTime stamp) override;
  /// Validates the scan and does not use it.
  [[nodiscard]] Status update(const LaserScan& scan) override;
  /// The quality is kLocalised as soon as there was odometry, and kDegraded after a jump.
  [[nodiscard]] PoseEstimate estimate() const override { return estimate_; }
  void reset(const Pose2& map_T_base) override;

  /// Replaces pose and covariance by an improved estimate (a measurement update), keeping the odometry's origin.
  void correct(const Pose2& map_T_base, const Matrix3& covariance);
  void set_quality(LocalisationQuality quality, std::string cause);

 private:
  [[nodiscard]] bool is_jump(const Pose2& increment, double dt_s) const;

  OdometryParams params_;
  PoseEstimate estimate_;
  std::optional<Pose2> last_odom_T_base_;
};

}  // namespace seeker::slam
