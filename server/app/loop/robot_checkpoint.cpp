// The map of a mission that builds one outlives a crash: it is kept on disk while the mission runs.

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "server/app/loop/robot_loop.hpp"

namespace seeker::app {
namespace {

bool builds_map(const api::MissionTask& task) {
  const auto* search = std::get_if<api::SearchMission>(&task);
  return std::holds_alternative<api::ExploreMission>(task) || (search != nullptr && search->explore);
}

/// Where the newest scan was kept. There is one in every map that has been kept.
std::optional<Pose2> last_place(const LineMap& map) {
  const auto newest = std::max_element(map.keyframes.begin(), map.keyframes.end(),
                                       [](const MapKeyframe& a, const MapKeyframe& b) { return a.stamp < b.stamp; });
  for (const MapNode& node : map.nodes) {
    if (newest != map.keyframes.end() && node.id == newest->node) {
      return node.map_T_node * newest->node_T_base;
    }
  }
  return std::nullopt;
}

}  // namespace

void RobotLoop::keep_checkpoint() {
  const api::MissionRequest* mission = missions_.request();
  slam::MapTracker* tracker = parts_.estimator->map_tracker();
  if (!on_checkpoint || mission == nullptr || tracker == nullptr || !builds_map(mission->task) ||
      !is_placed(pose_.quality)) {
    return;
  }
  const bool far =
      checkpoint_map_T_base_ && distance_m(*checkpoint_map_T_base_, pose_.map_T_base) >= params_.map.checkpoint_way_m;
  const bool due = far || now() - checkpoint_at_ >= params_.map.checkpoint_period;
  if (!due || checkpoint_waits_ || checkpoint_revision_ == tracker->revision()) {
    keep_place(mission->id);
    return;
  }
  checkpoint_at_ = now();
  checkpoint_map_T_base_ = pose_.map_T_base;
  checkpoint_revision_ = tracker->revision();
  checkpoint_waits_ = checkpoint_kept_ = true;
  on_checkpoint(mission->id, {{tracker->map(), map_.identity()}, missions_.behaviour()->memory(), mission_place()});
  place_at_ = now();
}

/// More often than the map, which costs more; it says nothing without one.
void RobotLoop::keep_place(const api::MissionId& mission) {
  if (!on_place || !checkpoint_kept_ || place_waits_ || now() - place_at_ < params_.map.place_period) {
    return;
  }
  place_at_ = now();
  place_waits_ = true;
  on_place(mission, mission_place());
}

MissionPlace RobotLoop::mission_place() const {
  return {pose_.map_T_base, missions_.so_far().value_or(MissionSoFar{})};
}

void RobotLoop::checkpoint_written(const Status& written) {
  checkpoint_waits_ = false;
  if (written) {
    clear("checkpoint-failed");
    return;
  }
  checkpoint_revision_.reset();
  raise("checkpoint-failed", "mission", "the map of the mission cannot be kept: " + written.error().message,
        "the mission goes on; after a crash it would begin without the newest part of its map",
        api::Severity::kWarning);
}

void RobotLoop::drop_checkpoints() {
  has_own_map_ = false;
  checkpoint_revision_.reset();
  const bool of_a_crash = unfinished_ && builds_map(unfinished_->task);
  if ((checkpoint_kept_ || of_a_crash) && on_checkpoints_void) {
    on_checkpoints_void();
  }
  checkpoint_kept_ = false;
}

std::optional<api::MissionId> RobotLoop::checkpoint_to_resume() const {
  const bool wanted = unfinished_ && builds_map(unfinished_->task) && map_.has_segments();
  return wanted && !missions_.present() && !resuming_ && !has_own_map_ ? std::optional(unfinished_->id) : std::nullopt;
}

bool RobotLoop::map_waits_for_resume() const {
  // A map that somebody has loaded meanwhile is meant to be used.
  return checkpoint_to_resume().has_value() && map_.identity().name.empty();
}

Status RobotLoop::resume_in_map(const Result<LineMap>& map, const MapIdentity& identity, const std::string& client,
                                KeptState kept) {
  if (authority_.estop()) {
    return fail(Errc::kRefused, "the emergency stop is latched; release it with 'seeker estop --release'");
  }
  if (!unfinished_) {
    return fail(Errc::kNotReady, "no mission was cut off");
  }
  if (Status able = able_to(unfinished_->task); !able) {
    return able;
  }
  const Status usable = map ? validate(*map) : Status(tl::unexpected<Error>(map.error()));
  if (!usable) {
    if (usable.error().code != Errc::kNotFound) {  // not found: cut off before there was one
      log("resume-without-map", usable.error().message, api::Severity::kWarning);
    }
    kept_ = {.map_T_base = std::nullopt, .topology = std::nullopt, .so_far = {std::nullopt, kept.so_far.running}};
    return command_mission(api::MissionCommand::kResume, client);
  }
  if (missions_.present()) {
    return may_change_map();
  }
  // Unlike load_map() for a robot that still rolls, too: it brakes, and stands no farther off than it is looked for.
  if (Status ok = map_.load(*map, identity, now()); !ok) {
    return ok;
  }
  forget_places();
  log("map-loaded", "the map of mission '" + unfinished_->id + "' is loaded; the robot looks for its place in it");
  if (const auto place = kept.map_T_base ? kept.map_T_base : last_place(*map)) {
    if (Status ok = map_.look_where_it_stood(*place, now()); !ok) {
      return ok;
    }
  }
  kept_ = std::move(kept);
  resuming_client_ = client;
  resuming_ = has_own_map_ = checkpoint_kept_ = true;
  resuming_at_ = now();
  looked_at_rad_.reset();
  looked_round_rad_ = 0.0;
  authority_.arm();  // who resumes a mission wants the robot to move
  return {};
}

/// A robot that is not found at once turns once on the spot: what is in its map may lie behind it.
Twist2 RobotLoop::look_round() {
  const bool soon = now() - resuming_at_ < params_.map.look_round_after;
  const std::string& owner = authority_.lease().owner;
  const bool in_other_hands = !owner.empty() && owner != resuming_client_;
  if (soon || in_other_hands || !odometry_ || !map_.relocalising() || looked_round_rad_ >= kTwoPi) {
    return {};
  }
  const double heading_rad = odometry_->odom_T_base.theta_rad;
  looked_round_rad_ += std::abs(wrap_angle(heading_rad - looked_at_rad_.value_or(heading_rad)));
  looked_at_rad_ = heading_rad;
  return {0.0, params_.map.look_round_rad_s};
}

void RobotLoop::resume_when_found() {
  // What is known to be floor decides what is left to explore: the kept scans are written into it first.
  if (!resuming_ || map_.relocalising() || !map_.settled()) {
    return;
  }
  resuming_ = false;
  if (!is_placed(pose_.quality)) {
    begin_map_anew();
  }
  const Result<api::MissionId> started = unfinished_
                                             ? start_mission(api::MissionRequest(*unfinished_), resuming_client_)
                                             : Result<api::MissionId>(fail(Errc::kNotReady, "no mission was cut off"));
  if (!started) {
    log("resume-failed", started.error().message, api::Severity::kError);
  }
}

/// Better than a robot that is lost for good: the fleet, or an operator, may lay the two maps upon each other later.
void RobotLoop::begin_map_anew() {
  log("resume-anew",
      "the robot did not find its place in the map it had (" + pose_.cause +
          "): the mission begins a new one, and the old one is saved under a name; to go on in that one, stop the "
          "mission, load it with 'seeker map load NAME' and help with 'seeker relocalise --at X,Y,DEG'",
      api::Severity::kWarning);
  if (on_checkpoint_unused && unfinished_) {
    on_checkpoint_unused(unfinished_->id);
  }
  has_own_map_ = false;
  kept_.topology.reset();
  kept_.so_far = {std::nullopt, kept_.so_far.running};
  map_.begin_anew();
  forget_places();
}

}  // namespace seeker::app
