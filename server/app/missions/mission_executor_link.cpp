// What a mission does while the client that started it is silent; all else of the executor is in mission_executor.cpp.

#include <utility>

#include "server/app/missions/mission_executor.hpp"
#include "server/app/missions/mission_rules.hpp"

namespace seeker::app {

void MissionExecutor::watch_link(const Situation& situation, WallTime wall_now) {
  while (const auto step = active_ ? active_->link.due(wall_now) : std::nullopt) {
    carry_out(*step, situation);
  }
}

void MissionExecutor::carry_out(const api::LinkStep& step, const Situation& situation) {
  const std::string cause = "the client '" + active_->owner + "' that started the mission is gone";
  const std::string remedy = "check the network; choose --link-policy continue to go on without a client";
  log(situation.now, "link-policy",
      cause + ": " + std::string(to_string(step.action)) + " after " +
          std::to_string(std::chrono::round<std::chrono::seconds>(step.after).count()) + " s of silence",
      api::Severity::kWarning);
  switch (step.action) {
    case api::LinkAction::kEvent: return;
    case api::LinkAction::kPause:
      if (running()) {
        pause(situation.now, cause);
        active_->paused_by_link = true;
      }
      return;
    case api::LinkAction::kStop: end(api::Outcome::kLinkLost, cause, remedy, situation.now); return;
    case api::LinkAction::kReturn:
      return_because({.outcome = api::Outcome::kLinkLost, .cause = cause, .remedy = remedy, .unreachable = {}},
                     situation);
      return;
    case api::LinkAction::kFinishStep: active_->finish_step = true; break;
    case api::LinkAction::kContinue: break;
  }
  end_link_pause(situation);
}

void MissionExecutor::return_because(const api::MissionEnd& why, const Situation& situation) {
  api::ReturnMission home = return_of(active_->request.task);
  home.along = active_->travelled.backwards(situation.pose.map_T_base.translation());
  Result<std::unique_ptr<Behaviour>> way_back = factory_(home, situation);
  if (!way_back) {
    end(why.outcome, why.cause + "; no way back: " + way_back.error().message, why.remedy, situation.now);
    return;
  }
  collect();
  keep_searched();
  api::MissionEnd end_after = active_->behaviour->pending_end().value_or(why);
  active_->behaviour = std::move(*way_back);
  active_->detection_base = findings_.highest_id();
  active_->end_after = std::move(end_after);
  log(situation.now, "returning", why.cause, api::Severity::kWarning);
  end_link_pause(situation);
}

/// What a person has paused, a person resumes.
void MissionExecutor::end_link_pause(const Situation& situation) {
  if (std::exchange(active_->paused_by_link, false)) {
    go_on(situation.now, "the link policy goes on");
  }
}

std::optional<api::LinkCountdown> MissionExecutor::link_countdown() const {
  return active_ ? active_->link.countdown() : std::nullopt;
}

void MissionExecutor::client_silent(const std::string& client, WallTime since) {
  if (active_ && active_->owner == client) {
    active_->link.silent(since);
  }
}

void MissionExecutor::client_back(const std::string& client, RobotTime now) {
  if (active_ && active_->owner == client && active_->link.end_silence()) {
    log(now, "link-back", "the client '" + client + "' that started the mission is heard again");
  }
}

}  // namespace seeker::app
