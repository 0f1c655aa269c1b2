#include "server/slam/odometry_scale.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace seeker::slam {

Matrix3 OdometryScale::applied_to(const Matrix3& covariance) const {
  const Eigen::Vector3d factors(std::sqrt(displacement_), std::sqrt(displacement_), std::sqrt(rotation_));
  return factors.asDiagonal() * covariance * factors.asDiagonal();
}

void OdometryScale::learn(const Eigen::Vector3d& off, const Matrix3& expected) {
  // With the right noise both ratios are 1 in the mean.
  const Point2 off_m = off.head<2>();
  const double displacement_ratio = off_m.dot(expected.topLeftCorner<2, 2>().ldlt().solve(off_m)) / 2.0;
  const double rotation_ratio = off[2] * off[2] / expected(2, 2);
  displacement_ = followed(displacement_, displacement_ratio);
  rotation_ = followed(rotation_, rotation_ratio);
}

double OdometryScale::followed(double scale, double ratio) const {
  const double wanted = std::clamp(scale * ratio, 1.0, params_.max);
  return scale + (wanted > scale ? params_.up : params_.down) * (wanted - scale);
}

}  // namespace seeker::slam
