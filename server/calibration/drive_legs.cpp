#include "server/calibration/drive_legs.hpp"

#include <cmath>
#include <utility>

#include "server/slam/covariance.hpp"

namespace seeker::calibration {

DriveLegs::DriveLegs(slam::PoseTracker& tracker, const DriveLegParams& params, const DriveCalibration& predicted)
    : tracker_(tracker), params_(params), predicted_(predicted) {}

void DriveLegs::add(const Pose2& odom_T_base, RobotTime stamp) {
  if (measured_T_base_) {
    const Pose2 increment = inverse(*measured_T_base_) * odom_T_base;
    odom_T_base_ = odom_T_base_ * corrected(increment, predicted_.wheels);
    rotation_rad_s_ = stamp > stamp_ ? increment.theta_rad / to_seconds(stamp - stamp_) : 0.0;
    if (first_ && increment != Pose2{}) {
      increments_.push_back(increment);
      path_m_ += increment.translation().norm();
      rotated_rad_ += std::abs(increment.theta_rad);
    }
  }
  measured_T_base_ = odom_T_base;
  stamp_ = stamp;
  (void)tracker_.predict(odom_T_base_, stamp);  // what it refuses, it says in its quality
}

void DriveLegs::add(const LaserScan& scan) {
  LaserScan mounted = scan;
  mounted.base_T_laser = predicted_.base_T_laser;
  if (!tracker_.update(mounted)) {
    return;
  }
  const PoseEstimate estimate = tracker_.estimate();
  if (!first_) {
    begin(estimate);
  } else if (leg_is_complete()) {
    end_leg(estimate);
    begin(estimate);
  }
}

bool DriveLegs::leg_is_complete() const {
  const bool calm = std::abs(rotation_rad_s_) <= params_.end_rotation_rad_s;
  return (calm && path_m_ > params_.length_m) || path_m_ > params_.longest_m || rotated_rad_ > params_.longest_rad;
}

void DriveLegs::begin(const PoseEstimate& estimate) {
  first_ = estimate;
  increments_.clear();
  path_m_ = 0.0;
  rotated_rad_ = 0.0;
}

void DriveLegs::end_leg(const PoseEstimate& estimate) {
  if (!is_placed(first_->quality) || !is_placed(estimate.quality) || first_->map_epoch != estimate.map_epoch) {
    ++unmatched_;
    return;
  }
  const Pose2& base_T_laser = predicted_.base_T_laser;
  const Pose2 moved_laser = inverse(first_->map_T_base * base_T_laser) * estimate.map_T_base * base_T_laser;
  legs_.push_back(
      {std::move(increments_), {moved_laser, slam::with_floor(Matrix3::Zero(), params_.sigma_m, params_.sigma_rad)}});
}

}  // namespace seeker::calibration
