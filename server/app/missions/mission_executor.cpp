#include "server/app/missions/mission_executor.hpp"

#include <utility>

#include "common/api/fleet.hpp"
#include "common/core/assert.hpp"
#include "server/app/estimators/estimator.hpp"
#include "server/app/missions/mission_rules.hpp"

namespace seeker::app {

MissionExecutor::MissionExecutor(const MissionParams& params, BehaviourFactory factory, MissionOutputs outputs)
    : params_(params), factory_(std::move(factory)), outputs_(std::move(outputs)), findings_(outputs_.detection) {}

Result<api::MissionId> MissionExecutor::start(const api::MissionRequest& request, const std::string& owner,
                                              const Situation& situation, const MissionSoFar& so_far) {
  if (const Status ok = api::validate(request); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (active_) {
    if (active_->request.id == request.id) {
      return request.id;
    }
    return fail(Errc::kBusy, "mission '" + active_->request.id + "' of '" + active_->owner +
                                 "' is running; wait for it or stop it first");
  }
  if (last_ && last_->id == request.id) {
    return fail(Errc::kInvalidArgument, "mission id '" + request.id + "' was used before; choose a new one");
  }
  // One that was cut off may have been on its way back in.
  if (const Status inside = check_start(request.task, situation.pose); !so_far.start_map && !inside) {
    return tl::unexpected<Error>(inside.error());
  }
  Result<std::unique_ptr<Behaviour>> behaviour = factory_(request.task, situation);
  if (!behaviour) {
    return tl::unexpected<Error>(behaviour.error());
  }
  findings_.take_back(so_far.found, situation.pose.map_epoch);
  Active active;
  active.request = request;
  active.owner = owner;
  active.behaviour = std::move(*behaviour);
  active.status.id = request.id;
  active.status.kind = api::task_name(request.task);
  active.status.phase = "start";
  active.status.started = situation.now - so_far.running;
  active.status.link_policy = request.link_policy;
  active.status.link_steps =
      request.link_steps.empty() ? api::link_steps_of(request.link_policy, params_.link_grace) : request.link_steps;
  active.link = LinkWatch(active.status.link_steps);
  active.detection_base = findings_.highest_id();
  active.pose = situation.pose.map_T_base;
  active.so_far = {so_far.start_map, so_far.running};
  if (so_far.start_map) {
    active.behaviour->remember_start(*so_far.start_map);
  }
  active.ran_at = situation.now;
  active.map_epoch = situation.pose.map_epoch;
  active_ = std::move(active);
  findings_.begin_mission();
  event_sequence_ = 0;
  if (outputs_.begun) {
    outputs_.begun(active_->request);
  }
  log(situation.now, "mission-started", active_->status.kind + " started");
  report(situation.now);
  return request.id;
}

void MissionExecutor::remember(const MissionMemory& memory) {
  if (active_) {
    active_->behaviour->remember(memory);
  }
}

Status MissionExecutor::command(api::MissionCommand command, RobotTime now) {
  if (!active_) {
    return fail(Errc::kNotReady, "no mission is running");
  }
  switch (command) {
    case api::MissionCommand::kStop: end(api::Outcome::kOperator, "stopped by the operator", "", now); return {};
    case api::MissionCommand::kPause:
      if (!running() && !std::exchange(active_->paused_by_link, false)) {
        return fail(Errc::kNotReady, "the mission is paused already");
      }
      pause(now, "paused by the operator");
      return {};
    case api::MissionCommand::kResume:
      if (running()) {
        return fail(Errc::kNotReady, "the mission is not paused");
      }
      go_on(now, "resumed by the operator");
      return {};
  }
  return fail(Errc::kInvalidArgument, "unknown mission command");
}

void MissionExecutor::go_on(RobotTime now, const std::string& why) {
  active_->paused_by_link = false;
  active_->status.state = api::MissionState::kRunning;
  active_->behaviour->resumed(now);
  log(now, "mission-resumed", why);
  report(now);
}

void MissionExecutor::pause(RobotTime now, const std::string& why) {
  if (active_) {
    active_->paused_by_link = false;
  }
  if (running()) {
    active_->status.state = api::MissionState::kPaused;
    active_->ran_at.reset();
    active_->blocked_since.reset();  // what the trouble is given begins anew when it goes on
    active_->unlocalised_since.reset();
    active_->status.activity = why;
    log(now, "mission-paused", why);
    report(now);
  }
}

void MissionExecutor::end(api::Outcome outcome, const std::string& cause, const std::string& remedy, RobotTime now) {
  if (active_) {
    finish(as_it_counts({.outcome = outcome, .cause = cause, .remedy = remedy, .unreachable = {}}), now);
  }
}

/// What cuts a way home short is not why the robot was sent home. The operator's word is the last in any case.
api::MissionEnd MissionExecutor::as_it_counts(api::MissionEnd end) const {
  if (end.outcome == api::Outcome::kOperator) {
    return end;
  }
  const auto why = active_->end_after ? active_->end_after : active_->behaviour->pending_end();
  return why ? after_return(*why, end) : end;
}

void MissionExecutor::finish(const api::MissionEnd& end, RobotTime now) {
  SEEKER_ASSERT(active_.has_value());
  collect();
  keep_searched();
  active_->status.state = api::MissionState::kEnded;
  active_->status.end = end;
  active_->status.planned_path.clear();
  active_->status.activity = end.cause;
  if (is_done(end.outcome)) {
    active_->status.progress = 1.0;
  }
  log(now, "mission-ended", std::string(to_string(end.outcome)) + ": " + end.cause);
  report(now);
  active_.reset();
}

Decision MissionExecutor::held(const Situation& situation, const std::string& activity) {
  Decision decision;
  active_->ran_at.reset();
  decision.phase = active_->status.phase;
  if (active_->status.activity != activity) {
    active_->status.activity = activity;
    report(situation.now);
  }
  return decision;
}

bool MissionExecutor::hold_for_trouble(const Situation& situation, const api::Fault* blocking) {
  if (blocking != nullptr) {
    if (!active_->blocked_since) {
      active_->blocked_since = situation.now;
      log(situation.now, "mission-held", blocking->message, blocking->severity);
    }
    if (situation.now - *active_->blocked_since > params_.fault_grace) {
      end(api::Outcome::kFault, blocking->message, blocking->remedy, situation.now);
    }
    return true;
  }
  const bool was_blocked = std::exchange(active_->blocked_since, std::nullopt).has_value();
  if (!is_placed(situation.pose.quality) && active_->behaviour->needs_pose()) {
    if (!active_->unlocalised_since) {
      active_->unlocalised_since = situation.now;
      log(situation.now, "mission-held", "the robot does not know where it is: " + situation.pose.cause,
          api::Severity::kError);
    }
    if (situation.relocalising) {
      active_->unlocalised_since = situation.now;
    } else if (situation.now - *active_->unlocalised_since > params_.lost_grace) {
      end(api::Outcome::kLost, situation.pose.cause, "drive the robot to a known place and start the mission again",
          situation.now);
    }
    return true;
  }
  if (was_blocked || active_->unlocalised_since) {
    active_->unlocalised_since.reset();
    active_->behaviour->resumed(situation.now);
    log(situation.now, "mission-continues", "the trouble is gone");
  }
  return false;
}

Decision MissionExecutor::step(const Situation& situation, const api::Fault* blocking, WallTime wall_now) {
  if (!active_) {
    return {};
  }
  watch_link(situation, wall_now);
  if (!active_ || !running()) {
    return {};
  }
  if (hold_for_trouble(situation, blocking)) {
    if (!active_) {
      return {};
    }
    Decision decision = held(situation, "waiting: " + (blocking != nullptr ? blocking->message : situation.pose.cause));
    decision.command.omega_rad_s = blocking == nullptr && situation.relocalising ? params_.look_round_rad_s : 0.0;
    return decision;
  }
  active_->count_time(situation.now);
  active_->so_far.start_map = active_->so_far.start_map.value_or(situation.pose.map_T_base.translation());
  Situation here = situation;
  here.time_left = active_->time_left();
  if (here.time_left && *here.time_left < Duration::zero()) {
    end(api::Outcome::kTimeLimit, "the time limit of the mission has passed", "give it more with --time-limit",
        situation.now);
    return {};
  }
  Decision decision = active_->behaviour->step(here);
  take(decision, situation);
  return decision;
}

void MissionExecutor::Active::count_time(RobotTime now) {
  so_far.running += ran_at ? now - *ran_at : Duration{0};
  ran_at = now;
}

std::optional<Duration> MissionExecutor::Active::time_left() const {
  return request.time_limit ? std::optional(*request.time_limit - so_far.running) : std::nullopt;
}

std::optional<MissionSoFar> MissionExecutor::so_far() const {
  if (!active_) {
    return std::nullopt;
  }
  MissionSoFar so_far = active_->so_far;
  so_far.found = findings_.detections_of_epoch(active_->map_epoch);
  return so_far;
}

void MissionExecutor::take(const Decision& decision, const Situation& situation) {
  api::MissionStatus& status = active_->status;
  const Pose2& pose = situation.pose.map_T_base;
  if (active_->last_pose) {
    status.path_length_m += distance_m(*active_->last_pose, pose);
  }
  active_->last_pose = active_->pose = pose;
  active_->travelled.note(pose.translation());
  active_->map_epoch = situation.pose.map_epoch;
  const bool new_phase = status.phase != decision.phase;
  status.phase = decision.phase;
  status.activity = decision.activity;
  status.progress = decision.progress;
  status.planned_path = decision.planned_path;
  if (decision.exploration) {
    status.decision = decision.exploration;
    active_->decision_reported = false;
  }
  for (const BehaviourEvent& event : decision.events) {
    log(situation.now, event.kind, event.text, event.severity);
  }
  if (!decision.events.empty()) {
    collect();
  }
  if (decision.end) {
    finish(active_->end_after ? after_return(*active_->end_after, *decision.end) : *decision.end, situation.now);
  } else if (active_->finish_step && decision.step_done) {
    end(api::Outcome::kLinkLost, "the client that started the mission is gone; the step was finished",
        "check the network", situation.now);
  } else if (new_phase || decision.exploration || situation.now - active_->last_report >= params_.report_period) {
    collect();
    report(situation.now);
  }
}

void MissionExecutor::on_recognition(const Recognition& recognition) {
  if (active_) {
    active_->behaviour->on_recognition(recognition);
    collect();
  }
}

void MissionExecutor::on_look(const Result<StereoLook>& look) {
  if (active_) {
    active_->behaviour->on_look(look);
  }
}

void MissionExecutor::map_moved(const MapCorrection& correction, RobotTime now) {
  if (active_) {
    const MapMove& move = correction.move;
    active_->behaviour->map_moved(move);
    active_->last_pose.reset();
    active_->pose = move * active_->pose;
    active_->travelled.move(move);
    if (active_->so_far.start_map) {
      active_->so_far.start_map = move * *active_->so_far.start_map;
    }
    active_->map_epoch = correction.to_epoch;
    if (move.moves()) {
      log(now, "map-moved", "the map was corrected; what was searched and found moved with it");
    }
    collect_detections();  // moved by the behaviour, which knows best how
  }
  findings_.map_moved(correction);
}

void MissionExecutor::collect() {
  if (std::optional<api::GridReport> grid = active_->behaviour->grid()) {
    active_->status.cells_searched = static_cast<int>(grid->lists.searched.size());
    active_->status.cells_unsearched = static_cast<int>(grid->lists.unsearched.size());
    active_->status.coverage = grid->evidence.summary;
    findings_.take_grid(std::move(*grid), active_->map_epoch);
  }
  collect_detections();
}

void MissionExecutor::collect_detections() {
  findings_.take_detections(active_->behaviour->detections(),
                            {active_->request.id, active_->detection_base, active_->map_epoch});
}

void MissionExecutor::keep_searched() {
  if (auto searched = active_->behaviour->searched(active_->pose.translation(), api::kMaxFleetSearchedSide_cells)) {
    findings_.keep_searched(std::move(*searched), active_->map_epoch);
  }
}

std::optional<SearchedFloor> MissionExecutor::searched(const PoseEstimate& at) const {
  auto now = active_ ? active_->behaviour->searched(at.map_T_base.translation(), api::kMaxFleetSearchedSide_cells)
                     : std::nullopt;
  return now ? now : findings_.searched(at.map_epoch);
}

void MissionExecutor::report(RobotTime now) {
  active_->last_report = now;
  active_->status.updated = now;
  last_ = active_->status;
  if (active_->decision_reported) {
    // Told once: the candidates of one decision are many times the rest of a report.
    api::MissionStatus status = active_->status;
    status.decision.reset();
    outputs_.status(status);
  } else {
    outputs_.status(active_->status);
    active_->decision_reported = true;
  }
}

void MissionExecutor::log(RobotTime now, const std::string& kind, const std::string& text, api::Severity severity) {
  outputs_.event({.sequence = ++event_sequence_,
                  .stamp = now,
                  .mission_time = now - active_->status.started,
                  .mission = active_->request.id,
                  .severity = severity,
                  .kind = kind,
                  .text = text});
}

}  // namespace seeker::app
