/// \file
/// Scan-to-map matching against local keyframes: the default estimator where a lidar is fitted.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/slam/local_cloud.hpp"
#include "server/slam/odometry_tracker.hpp"
#include "server/slam/scan_matcher.hpp"

namespace seeker::slam {

struct ScanMapParams {
  OdometryParams odometry;
  NormalParams normals;
  MatchParams match;
  LocalCloudParams cloud;
  std::size_t match_points = 180;  ///< number of points of a scan that are matched
  double min_move_m = 0.02;        ///< a scan after less motion than this is not matched
  double min_rotation_rad = 0.01;  ///< or after less rotation than this
  double good_ratio = 0.5;         ///< inlier ratio above which no wider search is made
  double accept_ratio = 0.25;      ///< inlier ratio below which the match is rejected
  double gap_m = 0.3;              ///< displacement since the last match beyond which a poor match is searched for
  double gap_rad = 0.2;            ///< rotation since the last match beyond which a poor match is searched for
  /// Share of points near known ones below which the scan shows unknown space rather than a contradiction.
  double new_space_ratio = 0.25;
  int lost_after = 10;            ///< consecutive scans without an accepted match
  double max_correction_m = 1.2;  ///< a match farther from the prediction is rejected
  double max_correction_rad = 0.6;
  double map_sigma_m = 0.005;  ///< error of the map itself, added to every match
  double map_sigma_rad = 0.002;
};

/// Predicts by odometry, corrects by matching each scan against the nearest keyframes (a Kalman update with the match's
/// covariance), and adds keyframes on the path. O(1) per scan. Without loop closure the drift is small, but not
/// bounded.
///
/// Quality: kLocalised; kDegraded with cause (corridor: odometry only along it; unknown space; odometry jump; a
/// rejected match); kLost after `lost_after` scans that contradict the map, with a search until one fits again.
class ScanMapTracker final : public PoseTracker {
 public:
  explicit ScanMapTracker(const ScanMapParams& params = {}, const Pose2& map_T_base = {});

  [[nodiscard]] Status predict(const Pose2& odom_T_base, RobotTime stamp) override;
  [[nodiscard]] Status update(const LaserScan& scan) override;
  [[nodiscard]] PoseEstimate estimate() const override { return odometry_.estimate(); }
  void reset(const Pose2& map_T_base) override;

  [[nodiscard]] std::size_t keyframe_count() const { return cloud_.size(); }
  /// The last match, for display and tests; no value before the first.
  [[nodiscard]] const std::optional<MatchResult>& last_match() const { return last_match_; }

 private:
  [[nodiscard]] MatchResult best_match(const std::vector<OrientedPoint>& points_base, const Pose2& predicted);
  [[nodiscard]] bool believable(const MatchResult& match, const Pose2& predicted) const;
  [[nodiscard]] bool is_new_space(const std::vector<OrientedPoint>& points_base, const Pose2& pose);
  void apply(const MatchResult& match);
  void note_failure(const std::vector<OrientedPoint>& points_base, const std::vector<OrientedPoint>& all_points);

  ScanMapParams params_;
  ScanMatcher matcher_;
  OdometryTracker odometry_;
  LocalCloud cloud_;
  Pose2 matched_pose_;  ///< estimate after the last match
  std::optional<RobotTime> last_scan_;
  std::optional<MatchResult> last_match_;
  int failures_ = 0;
};

}  // namespace seeker::slam
