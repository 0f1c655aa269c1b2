#include "server/app/goto_behaviour.hpp"

#include "common/core/text.hpp"

namespace seeker::app {
GotoBehaviour::GotoBehaviour(const GotoParams& params, api::GotoMission mission, std::optional<Polygon> bound)
    : params_(params), mission_(std::move(mission)), bound_(std::move(bound)), follower_(params.follower) {}

void GotoBehaviour::resumed(RobotTime /*now*/) {
  follower_.clear();
  planned_at_.reset();
}

void GotoBehaviour::map_moved(const Pose2& /*new_T_old*/) {
  follower_.clear();
  planned_at_.reset();
}

void GotoBehaviour::next_waypoint(Decision& decision) {
  ++current_;
  failures_ = 0;
  planned_at_.reset();
  follower_.clear();
  decision.step_done = true;
  if (current_ < mission_.waypoints.size()) {
    return;
  }
  decision.progress = 1.0;
  if (unreachable_.empty()) {
    decision.end = api::MissionEnd{
        .outcome = api::Outcome::kComplete, .cause = "all places visited", .remedy = "", .unreachable = {}};
  } else {
    decision.end = api::MissionEnd{.outcome = api::Outcome::kUnreachable,
                                   .cause = std::to_string(unreachable_.size()) + " of " +
                                            std::to_string(mission_.waypoints.size()) + " places cannot be reached",
                                   .remedy = "clear the way or choose other places",
                                   .unreachable = unreachable_};
  }
}

void GotoBehaviour::give_up(const std::string& why, Decision& decision) {
  const Point2& goal = mission_.waypoints[current_];
  unreachable_.push_back(goal);
  decision.events.push_back({"unreachable", text(goal) + " m: " + why, api::Severity::kWarning});
  next_waypoint(decision);
}

bool GotoBehaviour::plan(const Situation& situation, Decision& decision) {
  const auto occupancy = situation.map->snapshot();
  if (!occupancy) {
    decision.activity = "waiting for the first sweep";
    return false;
  }
  nav::CostMapLimits limits;
  limits.bound = bound_;
  limits.keep_out = mission_.keep_out;
  const Result<nav::CostMap> map = nav::CostMap::build(*occupancy, params_.cost_map, limits);
  const Pose2& pose = situation.pose.map_T_base;
  const Result<nav::Path> path =
      map ? nav::plan(*map, pose.translation(), mission_.waypoints[current_], params_.planner)
          : Result<nav::Path>(tl::unexpected<Error>(map.error()));
  planned_at_ = situation.now;
  if (!path) {
    give_up(path.error().message, decision);
    return false;
  }
  const bool last = current_ + 1 == mission_.waypoints.size();
  follower_.set_path(*path, situation.now, last ? mission_.final_heading_rad : std::nullopt);
  return true;
}

Decision GotoBehaviour::step(const Situation& situation) {
  Decision decision;
  decision.phase = "drive";
  const auto count = static_cast<double>(mission_.waypoints.size());
  decision.progress = static_cast<double>(current_) / count;
  const bool stale = !planned_at_ || situation.now - *planned_at_ >= params_.replan_period;
  if ((!follower_.active() || stale) && !plan(situation, decision)) {
    return decision;
  }
  const std::vector<Point2> points =
      situation.scan != nullptr ? points_in_base(*situation.scan) : std::vector<Point2>();
  const nav::FollowStep step = follower_.step(situation.pose.map_T_base, points, situation.now);
  decision.command = step.command;
  decision.planned_path = follower_.path().waypoints;
  decision.activity = "driving to " + text(mission_.waypoints[current_]) + " m, " +
                      std::to_string(static_cast<int>(step.remaining_m * 10.0) / 10) + " m to go";
  if (step.state == nav::FollowState::kArrived) {
    decision.events.push_back({"arrived", "at " + text(mission_.waypoints[current_]) + " m", api::Severity::kInfo});
    next_waypoint(decision);
  } else if (step.state == nav::FollowState::kBlocked || step.state == nav::FollowState::kStuck) {
    follower_.clear();
    planned_at_.reset();
    if (++failures_ >= params_.max_failures) {
      give_up(step.reason, decision);
    }
  }
  return decision;
}

}  // namespace seeker::app
