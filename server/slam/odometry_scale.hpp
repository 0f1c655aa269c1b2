/// \file
/// Scales the covariance of the odometry by its observed errors, estimated while driving.
#pragma once

#include "common/core/pose2.hpp"

namespace seeker::slam {

struct OdometryScaleParams {
  double max = 100.0;  ///< upper limit of the factors of the variances
  double up = 0.3;     ///< gain per scan of a growing factor
  double down = 0.02;  ///< gain per scan of a shrinking factor
};

/// Factors of the variances of the odometry, one for the displacement and one for the rotation: wheels with large
/// rotation errors often measure distances well, and a common factor would let a robot accept matches far along a
/// corridor. Never below 1.
class OdometryScale {
 public:
  explicit OdometryScale(const OdometryScaleParams& params = {}) : params_(params) {}

  /// The stated `covariance` of a motion (x, y, theta), in any frame, scaled by the estimated factors.
  [[nodiscard]] Matrix3 applied_to(const Matrix3& covariance) const;
  /// Updates the factors by the offset `off` (x, y, theta) of a match from the prediction, whose covariance is
  /// `expected` (positive definite).
  void learn(const Eigen::Vector3d& off, const Matrix3& expected);

  [[nodiscard]] double displacement() const { return displacement_; }
  [[nodiscard]] double rotation() const { return rotation_; }

 private:
  [[nodiscard]] double followed(double scale, double ratio) const;

  OdometryScaleParams params_;
  double displacement_ = 1.0;
  double rotation_ = 1.0;
};

}  // namespace seeker::slam
