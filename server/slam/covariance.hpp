/// \file
/// Small helpers for covariances of planar poses.
#pragma once

#include <Eigen/LU>

#include "common/core/pose2.hpp"

namespace seeker::slam {

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
