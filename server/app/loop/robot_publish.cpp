// What the loop tells: trajectory, streams, status.

#include "server/app/loop/robot_loop.hpp"

namespace seeker::app {

void RobotLoop::remember_pose() {
  // A robot that is looked for in its map has a pose in a frame of its own.
  const bool known = pose_.quality != LocalisationQuality::kUnknown || !map_.has_segments();
  if (known && (trajectory_.empty() ||
                distance_m(trajectory_.back().map_T_base, pose_.map_T_base) >= params_.trajectory_spacing_m)) {
    trajectory_.push_back({now(), pose_.map_T_base});
  }
  if (trajectory_.size() > params_.max_trajectory) {
    // Thin the older half: the shape stays, the memory is bounded.
    std::vector<api::StampedPose> thinned;
    const std::size_t half = trajectory_.size() / 2;
    for (std::size_t i = 0; i < trajectory_.size(); i += i < half ? 2 : 1) {
      thinned.push_back(trajectory_[i]);
    }
    trajectory_ = std::move(thinned);
  }
}

std::vector<Pose2> RobotLoop::trajectory() const {
  std::vector<Pose2> poses;
  poses.reserve(trajectory_.size());
  for (const api::StampedPose& pose : trajectory_) {
    poses.push_back(pose.map_T_base);
  }
  return poses;
}

void RobotLoop::publish_idle() {
  fresh_scan_ = fresh_sonar_ = false;
  map_.step();
  publish();
}

void RobotLoop::publish_tiles(RobotTime stamp) {
  api::TileUpdate update = map_.tiles_since(republish_ ? 0 : published_revision_);
  published_revision_ = update.revision;
  tiles_at_ = stamp;
  if (!update.tiles.empty()) {
    hub_.publish(api::Topic::kTiles, stamp, std::move(update));
  }
}

void RobotLoop::publish_segments(RobotTime stamp) {
  const Result<api::SegmentUpdate> update = map_.segments_since(republish_ ? 0 : published_segments_);
  if (!update) {
    return;
  }
  published_segments_ = update->revision;
  for (api::SegmentUpdate& part : api::split(*update)) {
    hub_.publish(api::Topic::kSegments, stamp, std::move(part));
  }
}

void RobotLoop::publish() {
  const RobotTime stamp = now();
  if (hub_.wanted(api::Topic::kStatus)) {
    hub_.publish(api::Topic::kStatus, stamp, status());
  }
  if ((fresh_scan_ || republish_) && scan_ && hub_.wanted(api::Topic::kScan)) {
    hub_.publish(api::Topic::kScan, stamp, *scan_);
  }
  if ((fresh_sonar_ || republish_) && sonar_ && hub_.wanted(api::Topic::kSonar)) {
    hub_.publish(api::Topic::kSonar, stamp, *sonar_);
  }
  // While the map is written anew the tiles of the one before would soon be void.
  if (hub_.wanted(api::Topic::kTiles) && !map_.rendering() &&
      (republish_ || stamp - tiles_at_ >= params_.tile_period)) {
    publish_tiles(stamp);
  }
  if (missions_.grid() && hub_.wanted(api::Topic::kGrid) && (republish_ || stamp - grid_at_ >= params_.grid_period)) {
    grid_at_ = stamp;
    hub_.publish(api::Topic::kGrid, stamp, *missions_.grid());
  }
  if ((map_.take_segments(stamp) || republish_) && hub_.wanted(api::Topic::kSegments)) {
    publish_segments(stamp);
  }
  republish_ = false;
}

api::RobotStatus RobotLoop::status() const {
  api::RobotStatus status;
  status.stamp = now();
  status.pose = pose_;
  if (odometry_) {
    status.odom_T_base = odometry_->odom_T_base;
    status.velocity = odometry_->velocity;
    status.battery_v = odometry_->battery_v;
  }
  status.estop = authority_.estop();
  status.motors_armed = authority_.armed();
  status.lease = authority_.lease();
  status.mission = missions_.last();
  if (status.mission) {
    status.mission->decision.reset();  // its candidates are many bytes; the mission's own topic has them
  }
  status.faults = faults_.all();
  status.safety = safety_reason_;
  status.clock_speed = parts_.devices.clock->speed();
  status.timing = parts_.devices.clock->timing();
  status.map_revision = map_.revision();
  status.line_map = map_.status();
  if (unfinished_) {
    status.cut_off = api::CutOffMission{unfinished_->id, std::string(api::task_name(unfinished_->task))};
  }
  return status;
}

std::vector<std::string> RobotLoop::capabilities() const {
  std::vector<std::string> words;
  const bool drivable = parts_.devices.base->drivable().has_value();
  const auto add = [&words](bool there, std::initializer_list<const char*> more) {
    words.insert(words.end(), there ? more.begin() : more.end(), more.end());
  };
  add(drivable, {"goto", "return", "drive"});
  add(parts_.devices.stereo && drivable, {"survey"});
  add(parts_.devices.stereo != nullptr, {"localise", "camera:left", "camera:right"});
  add(parts_.devices.camera && drivable, {"search"});
  if (parts_.devices.camera) {
    words.insert(words.end(), {"recognise", "camera:" + parts_.devices.camera_name});
  }
  if (parts_.devices.lidar) {
    words.emplace_back("lidar");
  }
  if (parts_.devices.sonar) {
    words.emplace_back("sonar");
  }
  add(map_.has_segments(), {"line_map"});
  add(map_.has_segments() && drivable, {"explore"});
  return words;
}

}  // namespace seeker::app
