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
  std::size_t match_points = 180;  ///< points of a scan that are matched
  double min_move_m = 0.02;        ///< a scan after less motion than this is not matched
  double min_turn_rad = 0.01;
  double good_ratio = 0.5;     ///< inlier ratio that needs no second look
  double accept_ratio = 0.25;  ///< below it the match is not believed
  double gap_m = 0.3;          ///< prediction since the last match beyond which a poor match is searched for
  double gap_rad = 0.2;
  double new_space_ratio = 0.25;  ///< fewer points than this near known ones: unseen space, not a contradiction
  int lost_after = 10;            ///< consecutive scans without a believed match
  double max_correction_m = 1.2;  ///< a match farther from the prediction is not believed
  double max_correction_rad = 0.6;
  double map_sigma_m = 0.005;  ///< error of the map itself, added to every match
  double map_sigma_rad = 0.002;
};

/// Predicts by odometry, corrects by matching each scan against the nearest keyframes (a Kalman update with the
/// match's covariance), and adds keyframes as it goes. O(1) per scan. Without loop closing: drift is small, not
/// bounded.
///
/// Quality: kLocalised; kDegraded with cause (corridor: odometry only along it; unseen space; odometry jump; a scan
/// that was not believed); kLost after `lost_after` scans that contradict the map, searching on until one fits again.
class ScanMapTracker final : public PoseTracker {
 public:
  explicit ScanMapTracker(const ScanMapParams& params = {}, const Pose2& map_T_base = {});

  [[nodiscard]] Status predict(const Pose2& odom_T_base, RobotTime stamp) override;
  [[nodiscard]] Status update(const LaserScan& scan) override;
  [[nodiscard]] PoseEstimate estimate() const override { return odometry_.estimate(); }
  void reset(const Pose2& map_T_base) override;

  [[nodiscard]] std::size_t keyframe_count() const { return cloud_.size(); }
  /// The last match, for display and tests; nothing before the first.
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
