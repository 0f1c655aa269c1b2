#include "server/app/missions/goto_behaviour.hpp"

#include <utility>

#include "common/core/text.hpp"
#include "server/nav/known_floor.hpp"
#include "server/nav/surroundings.hpp"

namespace seeker::app {
namespace {

/// Of the floor that is known to be connected; ways are planned on the finer map.
constexpr double kFloorCell_m = 0.2;
/// Shortest time between two looks at the floor where no way is planned, and at the walls.
constexpr double kMapPeriod_s = 1.0;
/// The robot looks round where no path is known and less than this is known about what is so near to it. What a wall
/// hides is not missing: something is known in its direction.
constexpr double kLook_m = 1.0;
constexpr double kUnseenShare = 0.08;

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

GotoBehaviour::GotoBehaviour(const GotoParams& params, api::GotoMission mission, std::optional<Polygon> bound,
                             std::size_t leading)
    : mission_(std::move(mission)),
      floors_(params.cost_map, {std::move(bound), mission_.keep_out}, kFloorCell_m, kMapPeriod_s),
      segments_(seconds(kMapPeriod_s)),
      robot_radius_m_(params.cost_map.robot_radius_m),
      drive_(driver_of(params), params.retry),
      leading_(leading) {}

void GotoBehaviour::resumed(RobotTime /*now*/) {
  drive_.interrupted();
  if (rotation_.active()) {
    rotation_.cancel();
    looked_round_ = false;  // not all the way
  }
}

void GotoBehaviour::map_moved(const MapMove& move) {
  floors_.transform(move);
  sonar_obstacles_.transform(move);
  segments_.forget();
  drive_.interrupted();
}

void GotoBehaviour::next_waypoint(Decision& decision) {
  ++current_;
  driving_ = false;
  looked_round_ = false;
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
                                            std::to_string(mission_.waypoints.size()) +
                                            " places cannot be reached: " + describe(unreachable_),
                                   .remedy = remedies_of(unreachable_),
                                   .unreachable = unreachable_};
  }
}

void GotoBehaviour::give_up(const nav::DriveFailure& why, Decision& decision) {
  const Point2& goal = mission_.waypoints[current_];
  UnreachablePlace place{.p_map = goal, .cause = why.cause, .text = ""};
  if (why.cause == UnreachableCause::kCutOff && areas_cut_off(goal)) {
    place.cause = UnreachableCause::kCutOffByAreas;
  } else if (why.cause == UnreachableCause::kBlocked) {
    place.text = std::string(explain(why.cause)) + " (" + why.text + ")";
  }
  decision.events.push_back({"unreachable", describe(place), api::Severity::kWarning});
  unreachable_.push_back(std::move(place));
  next_waypoint(decision);
}

bool GotoBehaviour::areas_cut_off(const Point2& goal_map) const {
  const auto unrestricted = floors_.unrestricted_floor();
  return unrestricted && unrestricted->contains(unrestricted->frame().cell_of(goal_map)) &&
         (*unrestricted)[unrestricted->frame().cell_of(goal_map)] != 0;
}

std::optional<UnreachableCause> GotoBehaviour::lasting_cause(const Situation& situation, const Point2& goal_map,
                                                             UnreachableCause cause) {
  if (floors_.areas().outside_bound(goal_map)) {
    return UnreachableCause::kOutsideBound;
  }
  if (floors_.areas().in_keep_out(goal_map)) {
    return UnreachableCause::kKeptOut;
  }
  if (situation.tracker != nullptr && nav::on_wall(goal_map, segments_.of(*situation.tracker, situation.now))) {
    return UnreachableCause::kObstacle;
  }
  switch (cause) {
    case UnreachableCause::kOutsideBound:
    case UnreachableCause::kKeptOut:
    case UnreachableCause::kRobotForbidden:
    case UnreachableCause::kUnknownFloor: return cause;
    default: return std::nullopt;
  }
}

bool GotoBehaviour::look_helps(const Situation& situation, UnreachableCause cause) const {
  const bool floor_is_missing = cause == UnreachableCause::kRobotEnclosed || cause == UnreachableCause::kCutOff ||
                                cause == UnreachableCause::kUnknownFloor;
  return floor_is_missing && !looked_round_ &&
         nav::unseen_share(*situation.map, situation.pose.map_T_base.translation(), robot_radius_m_, kLook_m) >
             kUnseenShare;
}

void GotoBehaviour::look_round(const Situation& situation, Decision& decision) {
  decision.phase = "look";
  decision.activity = "turning on the spot to see the floor around the robot: no path to " +
                      text(mission_.waypoints[current_]) + " m is known";
  decision.command = rotation_.step(situation);
  if (!rotation_.active()) {
    driving_ = false;  // all attempts again, with what has been observed
  }
}

void GotoBehaviour::cannot_drive(const Situation& situation, const nav::DriveFailure& why, bool over,
                                 Decision& decision) {
  if (current_ < leading_) {
    next_waypoint(decision);
    return;
  }
  const Point2& goal = mission_.waypoints[current_];
  const auto lasting = lasting_cause(situation, goal, why.cause);
  const UnreachableCause cause = lasting.value_or(why.cause);
  if (look_helps(situation, cause)) {
    looked_round_ = true;
    rotation_.start(situation);
    decision.events.push_back({"look-round", "turning on the spot to see more: " + why.text, api::Severity::kInfo});
    look_round(situation, decision);
  } else if (over || lasting) {
    give_up({cause, why.text}, decision);
  } else {
    decision.activity = "waiting for the way to " + text(goal) + " m to become free: " + why.text;
  }
}

void GotoBehaviour::drive(const Situation& situation, const nav::DriveInput& input, Decision& decision) {
  const Point2& goal = mission_.waypoints[current_];
  if (!std::exchange(driving_, true)) {
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
    cannot_drive(situation, {driven.cause, driven.reason}, true, decision);
  } else if (const auto& why = drive_.waiting_for()) {
    cannot_drive(situation, *why, false, decision);
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
  if (rotation_.active()) {
    look_round(situation, decision);
  } else {
    drive(situation, input, decision);
  }
  return decision;
}

}  // namespace seeker::app
