// What is expected of a scan and made of it: how the robot came there, whether it stands, how well its place is known.
#include <cmath>
#include <utility>

#include "server/slam/covariance.hpp"
#include "server/slam/line_slam.hpp"

namespace seeker::slam {
namespace {

/// Two ranges of one surface differ by no more than so many standard deviations of their difference.
constexpr double kNoiseSigmas = 3.0;

}  // namespace

Status LineSlam::check_repeats(const LaserScan& scan) {
  if (last_scan_ && scan.stamp <= *last_scan_) {
    return fail(Errc::kInvalidArgument, "the scan is not newer than the last one; the laser's driver repeats itself");
  }
  last_scan_ = scan.stamp;
  const Pose2& increment = travelled_.estimate().map_T_base;
  const bool driving = moved({}, increment, params_.min_move_m, params_.min_rotation_rad);
  repeated_ = scan.ranges_m == newest_ranges_;
  repeats_ = repeated_ && driving ? repeats_ + 1 : 0;
  newest_ranges_ = scan.ranges_m;
  if (repeats_ >= params_.repeats_fault) {
    quality_ = LocalisationQuality::kDegraded;
    cause_ = "the laser repeats one scan while the robot moves";
    return fail(Errc::kInvalidArgument,
                "the laser repeats one scan while the robot moves; restart it. The pose goes on by odometry");
  }
  return {};
}

Status LineSlam::check_direction() {
  if (!rotation_sense_.reversed()) {
    return {};
  }
  quality_ = LocalisationQuality::kLost;
  cause_ = "the scans rotate against the wheels";
  return fail(Errc::kInvalidArgument,
              "the scans rotate against the wheels: the beams run in the other direction, the scanner hangs "
              "upside down or the wheels are swapped; set the angle of the first beam and that between two beams, with "
              "their signs, and begin a new map");
}

PoseEstimate LineSlam::estimate() const {
  const PoseEstimate travelled = travelled_.estimate();
  const Pose2& map_T_node = backend_.pose(backend_.maps().back().id);
  const Pose2& node_T_base = lines_->robot();
  const Pose2 increment = odometry_bias_.corrected(travelled.map_T_base);
  const Pose2 node_T_now = node_T_base * increment;
  const Matrix3 to_a = compose_jacobian_a(node_T_base, increment);
  const Matrix3 to_b = compose_jacobian_b(node_T_base, increment);
  const Matrix3 moved = travelled.covariance + odometry_bias_.covariance_of(travelled.map_T_base);
  const Matrix3 in_node = to_a * lines_->robot_covariance_map() * to_a.transpose() + to_b * moved * to_b.transpose();
  const Matrix3 node_a = compose_jacobian_a(map_T_node, node_T_now);
  const Matrix3 node_b = compose_jacobian_b(map_T_node, node_T_now);
  PoseEstimate estimate;
  estimate.stamp = travelled.stamp;
  estimate.map_T_base = map_T_node * node_T_now;
  estimate.covariance =
      node_a * backend_.newest_covariance() * node_a.transpose() + node_b * in_node * node_b.transpose();
  // During relocalisation the pose in the whole map is unknown, whatever the quality in the local map is.
  const bool looked_for = backend_.apart() && quality_ != LocalisationQuality::kLost;
  estimate.quality = looked_for ? LocalisationQuality::kUnknown : quality_;
  estimate.cause = cause_;
  estimate.map_epoch = backend_.epoch();
  return estimate;
}

bool LineSlam::odometry_jumped() const { return travelled_.estimate().quality == LocalisationQuality::kDegraded; }

UncertainPose LineSlam::expected_motion(const PoseEstimate& travelled, bool silent, double dt_s) {
  if (silent && unseen_.on()) {
    return unseen_.expected(dt_s);
  }
  if (!silent) {
    unseen_.note_wheels();
  }
  odometry_bias_.note_motion(travelled.map_T_base, travelled.covariance);
  const Pose2 increment = odometry_bias_.corrected(travelled.map_T_base);
  const Matrix3 random = odometry_scale_.applied_to(to_base_frame(travelled.covariance, increment));
  return {increment, random + to_base_frame(odometry_bias_.covariance_of(travelled.map_T_base), increment)};
}

void LineSlam::note_distance(const Pose2& motion) {
  travelled_.correct({}, Matrix3::Zero());
  at_last_scan_ = {};
  travelled_.set_quality(LocalisationQuality::kLocalised, "");  // a jump is over once a scan has been used
  const double distance_m = std::hypot(motion.x_m, motion.y_m);
  distance_m_ += distance_m;
  distance_since_loops_m_ += distance_m;
  distance_since_kept_m_ += distance_m;
  distance_since_leftover_m_ += distance_m;
  rotation_since_leftover_rad_ += std::abs(motion.theta_rad);
}

void LineSlam::learn_odometry(const MatchResult& match, const Matrix3& covariance) {
  odometry_bias_.note_match(match.map_T_base, match.degenerate_direction);
  if (match.degenerate_direction) {
    return;
  }
  odometry_scale_.learn(offset_of(match.map_T_base, lines_->robot()), lines_->robot_covariance_map() + covariance);
}

SpUpdateReport LineSlam::update_lines(const std::vector<lines::SegmentObservation>& observations,
                                      const Association& association) {
  ++revision_;
  return lines_->update(observations, association);
}

void LineSlam::follow_lines(const std::vector<lines::SegmentObservation>& observations, const LaserScan& scan) {
  if (map_is_full()) {
    begin_next_map(scan.stamp, params_.points.carried_keyframes);
  }
  const SpUpdateReport report = update_lines(observations, lines_->associate(observations));
  counts_.paired += static_cast<std::uint64_t>(report.paired);
  lines_->observe_free_space(scan);
  matched_ = true;
  quality_ = LocalisationQuality::kLocalised;
  cause_.clear();
}

void LineSlam::note_quality(const MatchResult& match) {
  const bool corridor = match.degenerate_direction && lines_->observability().degenerate_direction;
  counts_.corridor += corridor ? 1 : 0;
  quality_ = corridor ? LocalisationQuality::kDegraded : LocalisationQuality::kLocalised;
  cause_ = corridor ? "the scan says nothing along the corridor: odometry only in that direction" : "";
}

bool LineSlam::is_early(const LaserScan& scan) {
  const Pose2 now = travelled_.estimate().map_T_base;
  const bool drives = moved(std::exchange(at_last_scan_, now), now, params_.unseen.still_m, params_.unseen.still_rad);
  return drives && to_seconds(scan.stamp - used_stamp_) < params_.observation_period_s;
}

bool LineSlam::stands_still(const LaserScan& scan) const {
  const bool healthy = failures_ == 0 && matched_ && !odometry_jumped() && !cloud_.empty() && !backend_.apart();
  if (!healthy || moved({}, travelled_.estimate().map_T_base, params_.min_move_m, params_.min_rotation_rad)) {
    return false;
  }
  // Wheels may be silent while the robot is pushed or slips: the view must be the same, too.
  if (scan.ranges_m.size() != used_ranges_.size()) {
    return false;
  }
  // A beam that came back in one of the two only says little: glass and the edge of the range flicker.
  // Until wheels have reported a motion only the view decides: along a corridor little changes.
  const double least_m = unseen_.trusted() ? params_.still_range_m : 0.0;
  const double share = unseen_.trusted() ? params_.still_share : params_.silent_share;
  std::size_t compared = 0;
  std::size_t changed = 0;
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const auto now_m = static_cast<double>(scan.ranges_m[beam]);
    const auto then_m = static_cast<double>(used_ranges_[beam]);
    if (std::isfinite(now_m) && std::isfinite(then_m)) {
      const double noise_m = kNoiseSigmas * std::sqrt(2.0) * noise_.sigma_m(now_m);
      ++compared;
      changed += std::abs(now_m - then_m) > std::max(least_m, noise_m) ? 1U : 0U;
    }
  }
  return compared > 0 && static_cast<double>(changed) <= share * static_cast<double>(compared);
}

void LineSlam::look_again(const LaserScan& scan) {
  const double dt_s = to_seconds(scan.stamp - std::exchange(used_stamp_, scan.stamp));
  if (unseen_.on()) {
    unseen_.note({}, dt_s);
    return;
  }
  const bool stands = unseen_.is_silent(travelled_.estimate().map_T_base);
  if (!stands || repeated_ || stood_ >= params_.stand_scans) {
    return;
  }
  ++stood_;
  ++counts_.stood;
  lines::ScanLines found;
  extractor_->extract(scan, found);
  noise_ = found.noise;
  const std::vector<lines::SegmentObservation> observations = lines::observe(scan, found, params_.observation);
  update_lines(observations, lines_->associate(observations));
}

}  // namespace seeker::slam
