/// \file
/// Small helpers for covariances of planar poses, and for what they are covariances of.
#pragma once

#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "common/core/pose2.hpp"

namespace seeker::slam {

/// How far `pose` lies off `from`, both in one frame: (x, y, theta) in that frame, theta the short way round.
[[nodiscard]] inline Eigen::Vector3d offset_of(const Pose2& pose, const Pose2& from) {
  return {pose.x_m - from.x_m, pose.y_m - from.y_m, wrap_angle(pose.theta_rad - from.theta_rad)};
}

/// The covariance with an independent error of these deviations added to (x, y, theta).
[[nodiscard]] inline Matrix3 with_floor(const Matrix3& covariance, double sigma_m, double sigma_rad) {
  return covariance + Eigen::Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2().asDiagonal().toDenseMatrix();
}

/// Its inverse, exactly symmetric.
[[nodiscard]] inline Matrix3 information_of(const Matrix3& covariance) {
  const Matrix3 information = covariance.inverse();
  return 0.5 * (information + information.transpose());
}

}  // namespace seeker::slam
