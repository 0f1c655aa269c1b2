/// \file
/// Small helpers for covariances of planar poses.
#pragma once

#include <Eigen/LU>

#include "common/core/pose2.hpp"

namespace seeker::slam {

/// Adds an independent error with these standard deviations to the covariance of (x, y, theta).
[[nodiscard]] inline Matrix3 with_floor(const Matrix3& covariance, double sigma_m, double sigma_rad) {
  return covariance + Eigen::Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2().asDiagonal().toDenseMatrix();
}

/// Inverse of the covariance, exactly symmetric.
[[nodiscard]] inline Matrix3 information_of(const Matrix3& covariance) {
  const Matrix3 information = covariance.inverse();
  return 0.5 * (information + information.transpose());
}

}  // namespace seeker::slam
