#include "server/app/loop/localiser.hpp"

#include <string>
#include <utility>

namespace seeker::app {
namespace {

std::optional<Pose2> odometry_pose(const Sensing& sensing) {
  return sensing.odometry() != nullptr ? std::optional(sensing.odom_T_base()) : std::nullopt;
}

}  // namespace

Localiser::Localiser(const LoopParams& params, const nav::OccupancyParams& occupancy,
                     std::unique_ptr<Estimator> estimator, Diagnostics& diagnostics)
    : estimator_(std::move(estimator)),
      diagnostics_(diagnostics),
      map_(params.map, occupancy, estimator_->map_tracker()),
      trajectory_(params.trajectory_spacing_m, params.max_trajectory),
      sees_pictures_(params.connections.pose.pictures) {}

void Localiser::give_odometry(const drivers::OdometrySample& sample) {
  last_odometry_given_ = sample.stamp;
  diagnostics_.note_reading(estimator_->on_odometry(sample), "odometry-refused");
}

LaserScan Localiser::carried(const LaserScan& scan, const OdometryHistory& history) const {
  const std::optional<drivers::OdometrySample> then = history.at(scan.stamp);
  const std::optional<drivers::OdometrySample> given = history.at(last_odometry_given_);
  LaserScan seen = scan;
  if (!then || !given) {
    return seen;
  }
  seen.base_T_laser = inverse(given->odom_T_base) * then->odom_T_base * scan.base_T_laser;
  return seen;
}

/// In the order of the stamps: a sweep arrives later than it was taken.
void Localiser::give_readings(const Sensing& sensing, const Neighbours& neighbours, RobotTime now) {
  const drivers::OdometrySample* odometry = sensing.new_odometry();
  if (odometry != nullptr && odometry->discontinued) {
    look_where_it_stood(odometry->odom_T_base, now);
  }
  const LaserScan* scan = sensing.motion_known() ? sensing.new_scan() : nullptr;
  const bool late = odometry != nullptr && scan != nullptr && scan->stamp < odometry->stamp;
  if (odometry != nullptr) {
    const std::optional<drivers::OdometrySample> then = late ? sensing.history().at(scan->stamp) : *odometry;
    if (!late || then->stamp > last_odometry_given_) {
      give_odometry(*then);
    }
  }
  if (scan != nullptr) {
    const std::vector<nav::Mover> others =
        neighbours.movers_base(estimator_->estimate().map_T_base, odometry_pose(sensing), now);
    without_movers_.reset();
    if (!others.empty()) {
      without_movers_ = nav::without_movers(*scan, Pose2{}, others);
    }
    if (sensing.connections().pose.scan) {
      const LaserScan& building = without_movers_ ? *without_movers_ : *scan;
      const bool overtaken = building.stamp < last_odometry_given_;
      diagnostics_.note_reading(estimator_->on_scan(overtaken ? carried(building, sensing.history()) : building),
                                "scan-refused");
    }
  }
  if (late) {
    give_odometry(*odometry);
  }
}

std::optional<MapShift> Localiser::localise(const Sensing& sensing, const Neighbours& neighbours, RobotTime now) {
  if (diagnostics_.components().stopped("pose")) {
    pose_.quality = LocalisationQuality::kLost;
    pose_.cause = "the estimator is not active";
    return std::nullopt;
  }
  give_readings(sensing, neighbours, now);
  if (sensing.new_odometry() == nullptr && sensing.new_scan() == nullptr) {
    return std::nullopt;
  }
  const std::optional<Pose2> odom_T_base = odometry_pose(sensing);
  std::optional<Pose2> by_odometry;
  if (odom_T_base_at_pose_ && odom_T_base) {
    by_odometry = pose_.map_T_base * (inverse(*odom_T_base_at_pose_) * *odom_T_base);
  }
  std::optional<MapShift> shift = follow_map(by_odometry, now);
  odom_T_base_at_pose_ = odom_T_base;
  diagnostics_.components().count_output("pose", "pose", now);
  return shift;
}

/// An epoch rises when a loop closure moves the map, and when a robot that was looked for is found: what it has mapped
/// meanwhile is joined to the map then, and nothing else moves. `old_map_T_base` is where the robot would be now in the
/// map before.
std::optional<MapShift> Localiser::follow_map(const std::optional<Pose2>& old_map_T_base, RobotTime now) {
  const std::uint32_t before = pose_.map_epoch;
  const bool was_placed = is_placed(pose_.quality);
  pose_ = map_.follow(estimator_->estimate(), now, old_map_T_base);
  if (pose_.map_epoch == before || !old_map_T_base) {
    return std::nullopt;
  }
  if (!was_placed) {
    // The pose before was in a frame of its own: it tells where the robot was looked for, not how the map has moved.
    diagnostics_.log("robot-found", "the robot has found its place in the map, which stays where it was");
    return MapShift{{.move = {}, .from_epoch = before, .to_epoch = pose_.map_epoch}, std::nullopt};
  }
  const int moved_mm = static_cast<int>(1e3 * distance_m(*old_map_T_base, pose_.map_T_base));
  diagnostics_.log("map-moved",
                   "the map was corrected; the robot's place in it moved by " + std::to_string(moved_mm) + " mm");
  return MapShift{{.move = map_.last_move(), .from_epoch = before, .to_epoch = pose_.map_epoch},
                  pose_.map_T_base * inverse(*old_map_T_base)};
}

void Localiser::look_where_it_stood(const Pose2& odom_T_base, RobotTime now) {
  const Pose2 unseen = odom_T_base_at_pose_ ? inverse(*odom_T_base_at_pose_) * odom_T_base : Pose2{};
  const Status looking = map_.look_where_it_stood(pose_.map_T_base * unseen, now);
  diagnostics_.log("moved-unseen",
                   looking ? "the base may have moved while it was not heard; the robot looks for its place in the map"
                           : "the base may have moved while it was not heard; the pose may be off by as much",
                   api::Severity::kWarning);
}

void Localiser::map_readings(const Sensing& sensing) {
  Components& components = diagnostics_.components();
  if (!is_placed(pose_.quality) || components.stopped("map") || !sensing.motion_known()) {
    return;
  }
  const OdometryHistory& history = sensing.history();
  const LaserScan* scan = sensing.maps_by_lidar() ? sensing.new_scan() : nullptr;
  const SonarScan* sonar = sensing.maps_by_lidar() ? nullptr : sensing.new_sonar();
  if (scan != nullptr) {
    const LaserScan& building = without_movers_ ? *without_movers_ : *scan;
    const Pose2 map_T_then = pose_.map_T_base * history.now_T_then(building.stamp);
    diagnostics_.note_reading(map_.integrate(building, map_T_then), "map-full");
    components.count_output("map", "map", pose_.stamp);
  } else if (sonar != nullptr) {
    const Pose2 map_T_then = pose_.map_T_base * history.now_T_then(sonar->stamp);
    diagnostics_.note_reading(map_.integrate(*sonar, map_T_then), "map-full");
    components.count_output("map", "map", pose_.stamp);
  }
}

void Localiser::note_pose(RobotTime now) {
  // A robot that is looked for in its map has a pose in a frame of its own.
  if (pose_.quality != LocalisationQuality::kUnknown || !map_.has_segments()) {
    trajectory_.add(now, pose_.map_T_base);
  }
}

void Localiser::place_at(const PoseEstimate& place, RobotTime now) {
  const bool in_map = estimator_->map_tracker() != nullptr;
  const Status placed = in_map ? map_.relocalise(place.map_T_base, now) : estimator_->place_at(place);
  take_estimate(now);
  diagnostics_.log("placed", placed ? "the estimator takes the place that was found" : placed.error().message,
                   placed ? api::Severity::kInfo : api::Severity::kWarning);
}

void Localiser::on_look(const Result<StereoLook>& look) {
  if (look && exchanged_at_ && look->stamp < *exchanged_at_) {
    return;  // it was meant for the estimator before
  }
  estimator_->on_look(look);
  for (const std::string& news : estimator_->take_news()) {
    diagnostics_.log("landmarks", news);
  }
}

void Localiser::take_estimate(RobotTime now) { pose_ = map_.follow(estimator_->estimate(), now); }

void Localiser::exchange(std::unique_ptr<Estimator> estimator, RobotTime now) {
  const std::unique_ptr<Estimator> before = std::exchange(estimator_, std::move(estimator));
  map_.exchange_tracker(estimator_->map_tracker(), estimator_->estimate().map_epoch);
  without_movers_.reset();
  odom_T_base_at_pose_.reset();
  last_odometry_given_ = RobotTime::min();
  exchanged_at_ = now;
}

void Localiser::forget_places(RobotTime now) {
  trajectory_.clear();
  take_estimate(now);
}

}  // namespace seeker::app
