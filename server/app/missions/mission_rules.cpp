#include "server/app/missions/mission_rules.hpp"

#include "common/core/assert.hpp"
#include "common/core/polygon.hpp"
#include "common/core/text.hpp"
#include "server/app/estimators/estimator.hpp"

namespace seeker::app {

api::ReturnMission return_of(const api::MissionTask& task) {
  api::ReturnMission home;
  const auto take_areas = [&home](const auto& mission) {
    if constexpr (requires { mission.bound; }) {
      home.bound = mission.bound;
    }
    if constexpr (requires { mission.keep_out; }) {
      home.keep_out = mission.keep_out;
    }
  };
  std::visit(take_areas, task);
  return home;
}

Status check_start(const api::MissionTask& task, const PoseEstimate& pose) {
  constexpr double kNear_m = 1.0;  // so near it is led in by the first plan
  const std::optional<Polygon> bound = return_of(task).bound;
  const Point2 here_map = pose.map_T_base.translation();
  if (!bound || !is_placed(pose.quality) || contains(*bound, here_map)) {
    return {};
  }
  const double off_m = distance_to_edge_m(*bound, here_map);
  return off_m <= kNear_m ? Status()
                          : fail(Errc::kRefused, "the robot is at " + text(here_map) + " m, " + text(off_m) +
                                                     " m outside the bound; drive it inside ('seeker goto'), or give a "
                                                     "bound around it");
}

bool is_done(api::Outcome outcome) {
  switch (outcome) {
    case api::Outcome::kComplete:
    case api::Outcome::kTargetFound:
    case api::Outcome::kNotFoundAreaCovered:
    case api::Outcome::kBoundReached: return true;
    case api::Outcome::kUnreachable:
    case api::Outcome::kTimeLimit:
    case api::Outcome::kUncertain:
    case api::Outcome::kLost:
    case api::Outcome::kBattery:
    case api::Outcome::kLinkLost:
    case api::Outcome::kOperator:
    case api::Outcome::kFault: return false;
  }
  SEEKER_ASSERT(false);
  return false;
}

api::MissionEnd after_return(api::MissionEnd why, const api::MissionEnd& end_of_return) {
  if (end_of_return.outcome == api::Outcome::kComplete) {
    why.cause += "; the robot is back where it was started";
    return why;
  }
  why.cause += "; the robot is not back at its start: " + end_of_return.cause;
  why.remedy += end_of_return.remedy.empty() ? "" : "; " + end_of_return.remedy;
  why.unreachable.insert(why.unreachable.end(), end_of_return.unreachable.begin(), end_of_return.unreachable.end());
  return why;
}

}  // namespace seeker::app
