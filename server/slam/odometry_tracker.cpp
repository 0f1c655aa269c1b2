#include "server/slam/odometry_tracker.hpp"

#include <cmath>
#include <utility>

namespace seeker::slam {

Matrix3 increment_covariance(const Pose2& increment, const OdometryParams& params) {
  const double distance_m = std::hypot(increment.x_m, increment.y_m);
  const double rotation_rad = std::abs(increment.theta_rad);
  const auto square = [](double x) { return x * x; };
  return Eigen::Vector3d(square(params.along_sigma_m_per_sqrt_m) * distance_m,
                         square(params.across_sigma_m_per_sqrt_m) * distance_m,
                         square(params.theta_sigma_rad_per_sqrt_m) * distance_m +
                             square(params.theta_sigma_rad_per_sqrt_rad) * rotation_rad)
      .asDiagonal();
}

OdometryTracker::OdometryTracker(const OdometryParams& params, const Pose2& map_T_base) : params_(params) {
  reset(map_T_base);
}

void OdometryTracker::reset(const Pose2& map_T_base) {
  const RobotTime stamp = estimate_.stamp;
  estimate_ = {};
  estimate_.stamp = stamp;
  estimate_.map_T_base = map_T_base;
  estimate_.cause = "no odometry yet";
  last_odom_T_base_.reset();
}

bool OdometryTracker::is_jump(const Pose2& increment, double dt_s) const {
  return std::hypot(increment.x_m, increment.y_m) > params_.jump_m + params_.jump_speed_m_s * dt_s ||
         std::abs(increment.theta_rad) > params_.jump_rad + params_.jump_speed_rad_s * dt_s;
}

Status OdometryTracker::predict(const Pose2& odom_T_base, RobotTime stamp) {
  if (!is_finite(odom_T_base)) {
    return fail(Errc::kInvalidArgument, "the odometry is not a number; check the base's driver");
  }
  if (!last_odom_T_base_) {
    last_odom_T_base_ = odom_T_base;
    estimate_.stamp = stamp;
    set_quality(LocalisationQuality::kLocalised, "");
    return {};
  }
  if (stamp < estimate_.stamp) {
    return fail(Errc::kInvalidArgument, "the odometry is older than the last one; check the order of the source");
  }
  const double dt_s = to_seconds(stamp - estimate_.stamp);
  const Pose2 increment = inverse(*last_odom_T_base_) * odom_T_base;
  last_odom_T_base_ = odom_T_base;
  estimate_.stamp = stamp;
  if (is_jump(increment, dt_s)) {
    estimate_.covariance += Eigen::Vector3d(params_.jump_sigma_m, params_.jump_sigma_m, params_.jump_sigma_rad)
                                .cwiseAbs2()
                                .asDiagonal()
                                .toDenseMatrix();
    set_quality(LocalisationQuality::kDegraded, "the odometry jumped");
    return fail(Errc::kInvalidArgument,
                "the odometry jumped farther than wheels can go; the jump is ignored, check encoders and base link");
  }
  const Matrix3 to_a = compose_jacobian_a(estimate_.map_T_base, increment);
  const Matrix3 to_b = compose_jacobian_b(estimate_.map_T_base, increment);
  estimate_.covariance = to_a * estimate_.covariance * to_a.transpose() +
                         to_b * increment_covariance(increment, params_) * to_b.transpose();
  estimate_.map_T_base = estimate_.map_T_base * increment;
  return {};
}

Status OdometryTracker::update(const LaserScan& scan) { return validate(scan); }

void OdometryTracker::correct(const Pose2& map_T_base, const Matrix3& covariance) {
  estimate_.map_T_base = map_T_base;
  estimate_.covariance = covariance;
}

void OdometryTracker::set_quality(LocalisationQuality quality, std::string cause) {
  estimate_.quality = quality;
  estimate_.cause = std::move(cause);
}

}  // namespace seeker::slam
