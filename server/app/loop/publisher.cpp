#include "server/app/loop/publisher.hpp"

#include <string>
#include <utility>

namespace seeker::app {

Publisher::Publisher(const LoopParams& params, const lines::ExtractorParams& lines, const Sources& sources,
                     UpdateHub& hub)
    : tile_period_(params.tile_period),
      grid_period_(params.grid_period),
      topology_period_(params.topology_period),
      sources_(sources),
      hub_(hub),
      lines_(lines) {}

void Publisher::publish() {
  const RobotTime stamp = sources_.world.now();
  if (hub_.wanted(api::Topic::kStatus)) {
    hub_.publish(api::Topic::kStatus, stamp, status());
  }
  publish_readings(stamp);
  publish_tiles(stamp);
  publish_grid(stamp);
  publish_segments(stamp);
  publish_topology(stamp);
  republish_ = false;
}

void Publisher::publish_readings(RobotTime stamp) {
  const Sensing& sensing = sources_.sensing;
  const bool scan_due = (sensing.new_scan() != nullptr || republish_) && sensing.scan() != nullptr;
  if (scan_due && hub_.wanted(api::Topic::kScan)) {
    hub_.publish(api::Topic::kScan, stamp, *sensing.scan());
  }
  if (scan_due && hub_.wanted(api::Topic::kLines)) {
    hub_.publish(api::Topic::kLines, stamp, lines_.report(*sensing.scan()));
  }
  if ((sensing.new_sonar() != nullptr || republish_) && sensing.sonar() != nullptr && hub_.wanted(api::Topic::kSonar)) {
    hub_.publish(api::Topic::kSonar, stamp, *sensing.sonar());
  }
}

void Publisher::publish_tiles(RobotTime stamp) {
  const RobotMap& map = sources_.localiser.map();
  const bool due = republish_ || stamp - tiles_at_ >= tile_period_;
  // While the map is written anew the tiles of the one before would soon be void.
  if (!due || map.rendering() || !hub_.wanted(api::Topic::kTiles)) {
    return;
  }
  api::TileUpdate update = map.tiles_since(republish_ ? 0 : published_revision_);
  published_revision_ = update.revision;
  tiles_at_ = stamp;
  if (!update.tiles.empty()) {
    hub_.publish(api::Topic::kTiles, stamp, std::move(update));
  }
}

void Publisher::publish_grid(RobotTime stamp) {
  const auto& grid = sources_.missions.findings().grid();
  if (grid && hub_.wanted(api::Topic::kGrid) && (republish_ || stamp - grid_at_ >= grid_period_)) {
    grid_at_ = stamp;
    hub_.publish(api::Topic::kGrid, stamp, *grid);
  }
}

void Publisher::publish_segments(RobotTime stamp) {
  RobotMap& map = sources_.localiser.map();
  const bool due = map.take_segments(stamp) || republish_;
  if (!due || !hub_.wanted(api::Topic::kSegments)) {
    return;
  }
  const Result<api::SegmentUpdate> update = map.segments_since(republish_ ? 0 : published_segments_);
  if (!update) {
    return;
  }
  published_segments_ = update->revision;
  for (api::SegmentUpdate& part : api::split(*update)) {
    hub_.publish(api::Topic::kSegments, stamp, std::move(part));
  }
}

/// A robot that does not know where it is has no place in the topology to report.
void Publisher::publish_topology(RobotTime stamp) {
  const bool due = republish_ || stamp - topology_at_ >= topology_period_;
  if (due && hub_.wanted(api::Topic::kTopology) && is_placed(sources_.localiser.pose().quality)) {
    topology_at_ = stamp;
    hub_.publish(api::Topic::kTopology, stamp, sources_.neighbours.own());
  }
}

api::RobotStatus Publisher::status() const {
  api::RobotStatus status;
  status.stamp = sources_.world.now();
  status.pose = sources_.localiser.pose();
  if (const drivers::OdometrySample* odometry = sources_.sensing.odometry()) {
    status.odom_T_base = odometry->odom_T_base;
    status.velocity = odometry->velocity;
    status.battery_v = odometry->battery_v;
  }
  const MotionAuthority& authority = sources_.motion.authority();
  status.estop = authority.estop();
  status.motors_armed = authority.armed();
  status.lease = authority.lease();
  status.mission = sources_.missions.last();
  if (status.mission) {
    status.mission->decision.reset();  // its candidates are many bytes; the mission's own topic has them
  }
  status.link_countdown = sources_.missions.link_countdown();
  status.faults = sources_.diagnostics.faults().all();
  status.safety = sources_.motion.safety_reason();
  status.clock_speed = sources_.world.speed();
  status.timing = sources_.world.timing();
  const RobotMap& map = std::as_const(sources_.localiser).map();
  status.map_revision = map.revision();
  status.line_map = map.status();
  if (const auto& unfinished = sources_.resumption.unfinished()) {
    status.cut_off = api::CutOffMission{unfinished->id, std::string(api::task_name(unfinished->task))};
  }
  return status;
}

}  // namespace seeker::app
