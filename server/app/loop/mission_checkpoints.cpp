#include "server/app/loop/mission_checkpoints.hpp"

#include <utility>

namespace seeker::app {

MissionCheckpoints::MissionCheckpoints(const RobotMapParams& params, const Localiser& localiser,
                                       Diagnostics& diagnostics, const LoopHooks& hooks)
    : params_(params), localiser_(localiser), diagnostics_(diagnostics), hooks_(hooks) {}

bool MissionCheckpoints::wanted_for(const api::MissionTask& task) {
  const auto* search = std::get_if<api::SearchMission>(&task);
  return std::holds_alternative<api::ExploreMission>(task) || (search != nullptr && search->explore);
}

void MissionCheckpoints::begin(RobotTime now) {
  at_ = now;
  map_T_base_ = localiser_.pose().map_T_base;
}

void MissionCheckpoints::keep(const MissionExecutor& missions, RobotTime now) {
  const api::MissionRequest* mission = missions.request();
  const slam::MapTracker* tracker = localiser_.tracker();
  const PoseEstimate& pose = localiser_.pose();
  if (!hooks_.on_checkpoint || mission == nullptr || tracker == nullptr || !wanted_for(mission->task) ||
      !is_placed(pose.quality)) {
    return;
  }
  const bool far = map_T_base_ && distance_m(*map_T_base_, pose.map_T_base) >= params_.checkpoint_distance_m;
  const bool due = far || now - at_ >= params_.checkpoint_period;
  if (!due || waits_ || revision_ == tracker->revision()) {
    keep_place(mission->id, missions, now);
    return;
  }
  at_ = now;
  map_T_base_ = pose.map_T_base;
  revision_ = tracker->revision();
  waits_ = kept_ = true;
  hooks_.on_checkpoint(
      mission->id, {{tracker->map(), localiser_.map().identity()}, missions.behaviour()->memory(), place(missions)});
  place_at_ = now;
}

/// More often than the map, which costs more; it says nothing without one.
void MissionCheckpoints::keep_place(const api::MissionId& mission, const MissionExecutor& missions, RobotTime now) {
  if (!hooks_.on_place || !kept_ || place_waits_ || now - place_at_ < params_.place_period) {
    return;
  }
  place_at_ = now;
  place_waits_ = true;
  hooks_.on_place(mission, place(missions));
}

MissionPlace MissionCheckpoints::place(const MissionExecutor& missions) const {
  return {localiser_.pose().map_T_base, missions.so_far().value_or(MissionSoFar{})};
}

void MissionCheckpoints::written(const Status& written) {
  waits_ = false;
  if (written) {
    diagnostics_.clear("checkpoint-failed");
    return;
  }
  revision_.reset();
  diagnostics_.raise(
      "checkpoint-failed", "mission", "the map of the mission cannot be kept: " + written.error().message,
      "the mission goes on; after a crash it would begin without the newest part of its map", api::Severity::kWarning);
}

void MissionCheckpoints::drop(bool of_a_crash) {
  revision_.reset();
  if ((kept_ || of_a_crash) && hooks_.on_checkpoints_void) {
    hooks_.on_checkpoints_void();
  }
  kept_ = false;
}

}  // namespace seeker::app
