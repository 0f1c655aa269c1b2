#include "server/slam/odometry_bias.hpp"

#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::slam {
namespace {

/// Cosine between an unconstrained direction and an axis above which the factors along the axis are not estimated.
constexpr double kSeenCosine = 0.5;

double square(double x) { return x * x; }

}  // namespace

OdometryBias::OdometryBias(const OdometryBiasParams& params) : params_(params) {
  sigmas_ << params.scale_sigma, params.drift_sigma_rad_per_m, params.rotation_scale_sigma, params.skew_sigma,
      params.lever_sigma_m;
  covariance_ = sigmas_.cwiseAbs2().asDiagonal();
}

Pose2 OdometryBias::corrected(const Pose2& increment) const {
  const double more_rad = drift_rad_per_m() * increment.x_m + rotation_scale_error() * increment.theta_rad;
  const double rotation_rad = increment.theta_rad + more_rad;
  // The displacement follows the arc: it is rotated by half of the correction of the heading.
  const Pose2 half_rotation{0.0, 0.0, 0.5 * more_rad};
  const Point2 along = half_rotation * Point2((1.0 + scale_error()) * increment.translation());
  const Point2 aside(lever_m() * (std::cos(rotation_rad) - 1.0),
                     skew() * increment.x_m + lever_m() * std::sin(rotation_rad));
  return {along.x() + aside.x(), along.y() + aside.y(), wrap_angle(rotation_rad)};
}

Matrix3 OdometryBias::covariance_of(const Pose2& increment) const {
  const double rotation_rad = increment.theta_rad;
  const double half_distance_m = 0.5 * increment.x_m;
  Eigen::Matrix<double, 3, kFactors> by_factor;  // of corrected(), where the factors are small
  by_factor.col(kScale) << increment.x_m, increment.y_m, 0.0;
  by_factor.col(kDrift) << -half_distance_m * increment.y_m, half_distance_m * increment.x_m, increment.x_m;
  by_factor.col(kRotation) << -0.5 * rotation_rad * increment.y_m, half_distance_m * rotation_rad, rotation_rad;
  by_factor.col(kSkew) << 0.0, increment.x_m, 0.0;
  by_factor.col(kLever) << std::cos(rotation_rad) - 1.0, std::sin(rotation_rad), 0.0;
  return by_factor * covariance_ * by_factor.transpose();
}

void OdometryBias::note_motion(const Pose2& increment, const Matrix3& covariance) {
  since_match_ = compose(since_match_, {increment, covariance});
}

void OdometryBias::note_match(const Pose2& frame_T_base, const std::optional<Point2>& unseen) {
  if (last_match_) {
    const Pose2 to_last{0.0, 0.0, -last_match_->theta_rad};
    learn(inverse(*last_match_) * frame_T_base, to_last * unseen.value_or(Point2::Zero()));
  }
  last_match_ = frame_T_base;
  since_match_ = {};
}

void OdometryBias::change_frame(const Pose2& new_T_old) {
  if (last_match_) {
    last_match_ = new_T_old * *last_match_;
  }
}

/// The motion between two matches, and a unit vector (zero: none) along which they say nothing, in the frame of the
/// first.
void OdometryBias::learn(const Pose2& matched, const Point2& unseen) {
  const Pose2& odometry = since_match_.a_T_b;
  const Matrix3& covariance = since_match_.covariance;
  const double driven_m = std::hypot(odometry.x_m, odometry.y_m);
  covariance_.diagonal() += driven_m * square(params_.drift_share) * sigmas_.cwiseAbs2();
  const Eigen::Vector3d off = offset_of(matched, corrected(odometry));
  const double match_m2 = square(params_.match_sigma_m);
  Vector row = Vector::Zero();
  row[kDrift] = odometry.x_m;
  row[kRotation] = odometry.theta_rad;
  correct(row, off[2], covariance(2, 2) + square(params_.match_sigma_rad));
  if (std::abs(unseen.x()) < kSeenCosine) {
    row.setZero();
    row[kScale] = odometry.x_m;
    correct(row, off[0], covariance(0, 0) + match_m2);
  }
  if (std::abs(unseen.y()) < kSeenCosine) {
    row.setZero();
    row[kSkew] = odometry.x_m;
    row[kLever] = odometry.theta_rad;
    correct(row, off[1], covariance(1, 1) + match_m2);
  }
}

void OdometryBias::correct(const Vector& row, double innovation, double variance) {
  const Vector by_factor = covariance_ * row;
  const double expected = row.dot(by_factor) + variance;
  if (square(innovation) > params_.gate * expected) {
    return;
  }
  factors_ += by_factor * (innovation / expected);
  covariance_ -= by_factor * by_factor.transpose() / expected;
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
}

}  // namespace seeker::slam
