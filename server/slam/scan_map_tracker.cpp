#include "server/slam/scan_map_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "server/slam/covariance.hpp"

namespace seeker::slam {
ScanMapTracker::ScanMapTracker(const ScanMapParams& params, const Pose2& map_T_base)
    : params_(params), matcher_(params.match), odometry_(params.odometry, map_T_base), cloud_(params.cloud) {
  reset(map_T_base);
}

void ScanMapTracker::reset(const Pose2& map_T_base) {
  odometry_.reset(map_T_base);
  cloud_.clear();
  matched_pose_ = map_T_base;
  last_scan_.reset();
  last_match_.reset();
  failures_ = 0;
}

Status ScanMapTracker::predict(const Pose2& odom_T_base, RobotTime stamp) {
  return odometry_.predict(odom_T_base, stamp);
}

bool ScanMapTracker::believable(const MatchResult& match, const Pose2& predicted) const {
  return match.pairs >= params_.match.min_pairs && match.inlier_ratio >= params_.accept_ratio &&
         !moved(predicted, match.map_T_base, params_.max_correction_m, params_.max_correction_rad);
}

MatchResult ScanMapTracker::best_match(const std::vector<OrientedPoint>& points_base, const Pose2& predicted) {
  const ReferenceCloud& reference = cloud_.around(predicted);
  MatchResult match = matcher_.match(reference, points_base, predicted);
  const bool gap = moved(matched_pose_, predicted, params_.gap_m, params_.gap_rad);
  if (!gap && match.inlier_ratio >= params_.good_ratio) {
    return match;
  }
  // After a gap even a fair match may be a wrong one, and a poor one may only have begun in the wrong place.
  return matcher_.match_widely(reference, points_base, predicted, odometry_.estimate().covariance, std::move(match));
}

bool ScanMapTracker::is_new_space(const std::vector<OrientedPoint>& points_base, const Pose2& pose) {
  const ReferenceCloud& reference = cloud_.around(pose);
  const auto known = std::count_if(points_base.begin(), points_base.end(), [&](const OrientedPoint& point) {
    return reference.nearest(pose * point.p, params_.match.first_gate_m) != nullptr;
  });
  return static_cast<double>(known) < params_.new_space_ratio * static_cast<double>(points_base.size());
}

void ScanMapTracker::apply(const MatchResult& match) {
  const PoseEstimate prior = odometry_.estimate();
  const Matrix3 measured = with_floor(match.covariance, params_.map_sigma_m, params_.map_sigma_rad);
  const Eigen::Vector3d innovation = offset_of(match.map_T_base, prior.map_T_base);
  const Matrix3 gain = prior.covariance * (prior.covariance + measured).inverse();
  const Eigen::Vector3d correction = gain * innovation;
  // Joseph form: stays symmetric and positive.
  const Matrix3 keep = Matrix3::Identity() - gain;
  const Matrix3 covariance = keep * prior.covariance * keep.transpose() + gain * measured * gain.transpose();
  const Pose2 pose{prior.map_T_base.x_m + correction[0], prior.map_T_base.y_m + correction[1],
                   wrap_angle(prior.map_T_base.theta_rad + correction[2])};
  odometry_.correct(pose, 0.5 * (covariance + covariance.transpose()));
  matched_pose_ = pose;
  failures_ = 0;
  if (match.degenerate_direction) {
    odometry_.set_quality(LocalisationQuality::kDegraded,
                          "the scan says nothing along the corridor: odometry only in that direction");
  } else {
    odometry_.set_quality(LocalisationQuality::kLocalised, "");
  }
}

void ScanMapTracker::note_failure(const std::vector<OrientedPoint>& points_base,
                                  const std::vector<OrientedPoint>& all_points) {
  const Pose2 pose = odometry_.estimate().map_T_base;
  if (is_new_space(points_base, pose)) {
    failures_ = 0;
    odometry_.set_quality(LocalisationQuality::kDegraded, "unseen space: the pose goes on by odometry");
    if (cloud_.needs_keyframe(pose)) {
      cloud_.add(pose, all_points);
    }
    return;
  }
  ++failures_;
  if (failures_ >= params_.lost_after) {
    odometry_.set_quality(LocalisationQuality::kLost, std::to_string(failures_) + " scans in a row do not fit the map");
  } else {
    odometry_.set_quality(LocalisationQuality::kDegraded, "the scan does not fit the map");
  }
}

Status ScanMapTracker::update(const LaserScan& scan) {
  if (auto valid = validate(scan); !valid) {
    return valid;
  }
  if (last_scan_ && scan.stamp <= *last_scan_) {
    return fail(Errc::kInvalidArgument, "the scan is not newer than the last one; the laser's driver repeats itself");
  }
  last_scan_ = scan.stamp;
  const std::vector<OrientedPoint> all_points = oriented_points(scan, params_.normals);
  if (all_points.size() < static_cast<std::size_t>(params_.match.min_pairs)) {
    odometry_.set_quality(LocalisationQuality::kDegraded, "too few returns: the pose goes on by odometry");
    return fail(Errc::kNotReady, "the scan has too few returns on surfaces to say where the robot is");
  }
  const Pose2 predicted = odometry_.estimate().map_T_base;
  if (cloud_.empty()) {
    cloud_.add(predicted, all_points);
    matched_pose_ = predicted;
    return {};
  }
  const bool healthy = failures_ == 0 && odometry_.estimate().quality == LocalisationQuality::kLocalised;
  if (healthy && last_match_ && !moved(matched_pose_, predicted, params_.min_move_m, params_.min_rotation_rad)) {
    return {};
  }
  const std::vector<OrientedPoint> points = thin_out(all_points, params_.match_points);
  last_match_ = best_match(points, predicted);
  if (!believable(*last_match_, predicted)) {
    note_failure(points, all_points);
    return {};
  }
  apply(*last_match_);
  if (cloud_.needs_keyframe(matched_pose_)) {
    cloud_.add(matched_pose_, all_points);
  }
  return {};
}

}  // namespace seeker::slam
