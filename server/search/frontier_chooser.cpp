#include "server/search/goal_chooser.hpp"

namespace seeker::search {
std::optional<Goal> FrontierChooser::choose(const ChooseInput& input) {
  for (const nav::Frontier& frontier : nav::find_frontiers(input.floor.cost, input.costs, params_.min_frontier_m)) {
    if (!nav::near_any(frontier.p_map, input.unreachable, params_.failed_radius_m) &&
        !nav::near_any(frontier.p_map, seen_frontiers_, params_.frontier_reach_m)) {
      return Goal{frontier.p_map, "nearest frontier", true, 0.0, {}, frontier.length_m};
    }
  }
  return std::nullopt;
}

void FrontierChooser::visited(const Goal& goal, const Pose2& /*map_T_base*/) { seen_frontiers_.push_back(goal.p_map); }

void FrontierChooser::transform(const MapMove& move) {
  for (Point2& p : seen_frontiers_) {
    p = move * p;
  }
}

}  // namespace seeker::search
