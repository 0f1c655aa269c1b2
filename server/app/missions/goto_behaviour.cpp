#include "server/app/missions/goto_behaviour.hpp"

#include <utility>

#include "common/core/text.hpp"
#include "server/nav/known_floor.hpp"

namespace seeker::app {
namespace {

/// Of the floor that is known to be connected; ways are planned on the finer map.
constexpr double kFloorCell_m = 0.2;
/// Shortest time between two looks at the floor where no way is planned, and at the walls.
constexpr double kMapPeriod_s = 1.0;

nav::DriverParams driver_of(const GotoParams& params) {
  nav::DriverParams driver;
  driver.max_failures = params.max_failures;
  driver.follower = params.follower;
  driver.planner = params.planner;
  driver.replan_period_s = to_seconds(params.replan_period);
  driver.close_enough_m = 0.0;  // the place itself was asked for
  return driver;
}

}  // namespace

GotoBehaviour::GotoBehaviour(const GotoParams& params, api::GotoMission mission, std::optional<Polygon> bound)
    : mission_(std::move(mission)),
      floors_(params.cost_map, {std::move(bound), mission_.keep_out}, kFloorCell_m, kMapPeriod_s),
      segments_(seconds(kMapPeriod_s)),
      drive_(driver_of(params), params.retry) {}

void GotoBehaviour::resumed(RobotTime /*now*/) { drive_.interrupted(); }

void GotoBehaviour::map_moved(const MapMove& move) {
  floors_.transform(move);
  sonar_obstacles_.transform(move);
  segments_.forget();
  drive_.interrupted();
}

void GotoBehaviour::next_waypoint(Decision& decision) {
  ++current_;
  under_way_ = false;
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

bool GotoBehaviour::stays_blocked(const Situation& situation, const Point2& goal_map) {
  if (!floors_.areas().allows(goal_map)) {
    return true;
  }
  return situation.tracker != nullptr && nav::on_wall(goal_map, segments_.of(*situation.tracker, situation.now));
}

void GotoBehaviour::drive(const Situation& situation, const nav::DriveInput& input, Decision& decision) {
  const Point2& goal = mission_.waypoints[current_];
  if (!std::exchange(under_way_, true)) {
    const bool last = current_ + 1 == mission_.waypoints.size();
    drive_.go(goal, input.now, last ? mission_.final_heading_rad : std::nullopt);
  }
  const nav::DriveStep driven = drive_.step(input);
  decision.command = driven.command;
  decision.planned_path = drive_.path();
  decision.activity = "driving to " + text(goal) + " m, " + text(driven.remaining_m) + " m to go";
  if (driven.state == nav::DriveState::kArrived) {
    decision.events.push_back({"arrived", "at " + text(goal) + " m", api::Severity::kInfo});
    next_waypoint(decision);
  } else if (driven.state == nav::DriveState::kFailed) {
    give_up(driven.reason, decision);
  } else if (!drive_.waiting_for().empty()) {
    decision.activity = "waiting for the way to " + text(goal) + " m to become free: " + drive_.waiting_for();
    if (stays_blocked(situation, goal)) {
      give_up(drive_.waiting_for(), decision);
    }
  }
}

Decision GotoBehaviour::step(const Situation& situation) {
  Decision decision;
  decision.phase = "drive";
  const auto count = static_cast<double>(mission_.waypoints.size());
  decision.progress = static_cast<double>(current_) / count;
  const Pose2& map_T_base = situation.pose.map_T_base;
  floors_.attend(*situation.map, map_T_base, situation.now, situation.movers);
  if (!map_seen_) {
    const auto floor = floors_.view();
    if (!floor && floor.error().code == Errc::kNotReady) {
      decision.activity = "waiting for the first sweep";
      return decision;
    }
    map_seen_ = true;
  }
  const nav::DriveInput input{situation.now, map_T_base, situation.sonar, situation.scan, floors_};
  sonar_obstacles_.note(input);
  drive(situation, input, decision);
  return decision;
}

}  // namespace seeker::app
