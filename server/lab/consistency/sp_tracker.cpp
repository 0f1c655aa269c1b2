#include "server/lab/consistency/sp_tracker.hpp"

#include <cmath>

namespace seeker::lab {

SpTracker::SpTracker(const SpTrackerParams& params)
    : params_(params), extractor_(lines::make_extractor(params.lines)), map_({}, Matrix3::Zero(), params.map) {}

Matrix3 SpTracker::increment_covariance(const Pose2& increment) const {
  const double distance_m = std::hypot(increment.x_m, increment.y_m);
  const sim::OdometryModel& m = params_.odometry;
  const double along = m.sigma_distance * m.sigma_distance * distance_m;
  const double rotation = m.sigma_rotation * m.sigma_rotation * std::abs(increment.theta_rad) +
                          m.sigma_rotation_per_distance * m.sigma_rotation_per_distance * distance_m;
  const double slip = params_.slip_sigma_m * params_.slip_sigma_m;
  // The heading error is a random walk along the path: its integral is the lateral error.
  Matrix3 c = Matrix3::Zero();
  c(0, 0) = along + slip;
  c(1, 1) = rotation * distance_m * distance_m / 3.0 + slip;
  c(1, 2) = c(2, 1) = rotation * distance_m / 2.0;
  c(2, 2) = rotation;
  return c;
}

Status SpTracker::predict(const Pose2& odom_T_base, RobotTime stamp) {
  stamp_ = stamp;
  if (last_odom_T_base_) {
    const Pose2 increment = inverse(*last_odom_T_base_) * odom_T_base;
    map_.predict(increment, increment_covariance(increment));
  }
  last_odom_T_base_ = odom_T_base;
  return {};
}

Status SpTracker::update(const LaserScan& scan) {
  extractor_->extract(scan, found_);
  const std::vector<lines::SegmentObservation> observations = lines::observe(scan, found_, params_.observation);
  report_ = map_.update(observations, map_.associate(observations));
  map_.observe_free_space(scan);
  return {};
}

PoseEstimate SpTracker::estimate() const {
  PoseEstimate estimate;
  estimate.stamp = stamp_;
  estimate.map_T_base = map_.robot();
  estimate.covariance = map_.robot_covariance_map();
  estimate.quality = LocalisationQuality::kLocalised;
  return estimate;
}

void SpTracker::reset(const Pose2& map_T_base) { map_.set_robot(map_T_base, Matrix3::Zero()); }

}  // namespace seeker::lab
