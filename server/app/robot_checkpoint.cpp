// The map of a mission that builds one outlives a crash: it is kept on disk while the mission runs.

#include "server/app/robot_loop.hpp"

namespace seeker::app {
namespace {

bool builds_map(const api::MissionTask& task) {
  const auto* search = std::get_if<api::SearchMission>(&task);
  return std::holds_alternative<api::ExploreMission>(task) || (search != nullptr && search->explore);
}

}  // namespace

void RobotLoop::keep_checkpoint() {
  const api::MissionRequest* mission = missions_.request();
  slam::MapTracker* tracker = parts_.estimator->map_tracker();
  if (!on_checkpoint || mission == nullptr || tracker == nullptr || !builds_map(mission->task)) {
    return;
  }
  const bool due = now() - checkpoint_at_ >= params_.map.checkpoint_period;
  if (!due || checkpoint_waits_ || map_.relocalising() || checkpoint_revision_ == tracker->revision()) {
    return;
  }
  checkpoint_at_ = now();
  checkpoint_revision_ = tracker->revision();
  checkpoint_waits_ = checkpoint_kept_ = true;
  on_checkpoint(mission->id, {tracker->map(), map_.identity()});
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

Status RobotLoop::resume_in_map(const Result<LineMap>& map, const MapIdentity& identity) {
  if (authority_.estop()) {
    return fail(Errc::kRefused, "the emergency stop is latched; release it with 'seeker estop --release'");
  }
  const Status usable = map ? validate(*map) : Status(tl::unexpected<Error>(map.error()));
  if (!usable) {
    if (usable.error().code != Errc::kNotFound) {  // not found: cut off before there was one
      log("resume-without-map", usable.error().message, api::Severity::kWarning);
    }
    return command_mission(api::MissionCommand::kResume);
  }
  if (Status ok = load_map(*map, identity); !ok) {
    return ok;
  }
  resuming_ = has_own_map_ = checkpoint_kept_ = true;
  return {};
}

void RobotLoop::resume_when_found() {
  if (!resuming_ || map_.relocalising()) {
    return;
  }
  resuming_ = false;
  const bool found =
      pose_.quality == LocalisationQuality::kLocalised || pose_.quality == LocalisationQuality::kDegraded;
  const Result<api::MissionId> started =
      found && unfinished_ ? start_mission(api::MissionRequest(*unfinished_), "resumed")
                           : Result<api::MissionId>(fail(
                                 Errc::kNotReady, "the robot did not find its place in the map it had (" + pose_.cause +
                                                      "); help with 'seeker relocalise --at X,Y,DEG --wait', then "
                                                      "'seeker resume'"));
  if (!started) {
    log("resume-failed", started.error().message, api::Severity::kError);
  }
}

}  // namespace seeker::app
