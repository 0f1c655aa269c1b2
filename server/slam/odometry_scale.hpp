/// \file
/// How much worse a robot's odometry is than it is said to be, learnt while it drives.
#pragma once

#include "common/core/pose2.hpp"

namespace seeker::slam {

struct OdometryScaleParams {
  double max = 100.0;  ///< of the variances
  double up = 0.3;     ///< how fast a scale follows what was seen, per scan
  double down = 0.02;
};

/// Factors of the variances of odometry, one of the way and one of the turn: wheels that turn badly often measure ways
/// well, and a robot that expects its ways to be as bad takes matches far along a corridor. Never below 1.
class OdometryScale {
 public:
  explicit OdometryScale(const OdometryScaleParams& params = {}) : params_(params) {}

  /// The stated `covariance` of a motion (x, y, theta), any frame, as it has turned out to be.
  [[nodiscard]] Matrix3 applied_to(const Matrix3& covariance) const;
  /// A match lay `off` (x, y, theta) the prediction; `expected` covariance of that, positive definite.
  void learn(const Eigen::Vector3d& off, const Matrix3& expected);

  [[nodiscard]] double way() const { return way_; }
  [[nodiscard]] double turn() const { return turn_; }

 private:
  [[nodiscard]] double followed(double scale, double ratio) const;

  OdometryScaleParams params_;
  double way_ = 1.0;
  double turn_ = 1.0;
};

}  // namespace seeker::slam
