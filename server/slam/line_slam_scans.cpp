// Which scans say something new: those that repeat, and those of a robot that stands.
#include <cmath>

#include "server/slam/line_slam.hpp"

namespace seeker::slam {

Status LineSlam::check_repeats(const LaserScan& scan) {
  if (last_scan_ && scan.stamp <= *last_scan_) {
    return fail(Errc::kInvalidArgument, "the scan is not newer than the last one; the laser's driver repeats itself");
  }
  last_scan_ = scan.stamp;
  const Pose2& increment = travelled_.estimate().map_T_base;
  const bool driving = moved({}, increment, params_.min_move_m, params_.min_turn_rad);
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

bool LineSlam::odometry_jumped() const { return travelled_.estimate().quality == LocalisationQuality::kDegraded; }

SpUpdateReport LineSlam::update_lines(const std::vector<lines::SegmentObservation>& observations,
                                      const Association& association) {
  ++revision_;
  return lines_->update(observations, association);
}

bool LineSlam::stands_still(const LaserScan& scan) const {
  const bool healthy = failures_ == 0 && matched_ && !odometry_jumped() && !cloud_.empty() && !backend_.apart();
  if (!healthy || moved({}, travelled_.estimate().map_T_base, params_.min_move_m, params_.min_turn_rad)) {
    return false;
  }
  // Wheels may say nothing while the robot is pushed or slips: the view must be the same too.
  if (scan.ranges_m.size() != used_ranges_.size()) {
    return false;
  }
  std::size_t changed = 0;
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const bool same = scan.ranges_m[beam] == used_ranges_[beam] ||
                      std::abs(scan.ranges_m[beam] - used_ranges_[beam]) <= static_cast<float>(params_.still_range_m);
    changed += same ? 0 : 1;
  }
  return static_cast<double>(changed) <= params_.still_share * static_cast<double>(scan.ranges_m.size());
}

void LineSlam::look_again(const LaserScan& scan) {
  const bool stands = !moved({}, travelled_.estimate().map_T_base, params_.stand_m, params_.stand_rad);
  if (!stands || repeated_ || stood_ >= params_.stand_scans) {
    return;
  }
  ++stood_;
  ++counts_.stood;
  lines::ScanLines found;
  extractor_.extract(scan, found);
  const std::vector<lines::SegmentObservation> observations = lines::observe(scan, found, params_.observation);
  update_lines(observations, lines_->associate(observations));
}

}  // namespace seeker::slam
