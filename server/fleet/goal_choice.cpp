#include "server/fleet/goal_choice.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "common/core/assert.hpp"

namespace seeker::fleet {
namespace {

/// What a place in sight of no unknown floor is worth: the rules kept it, so that somebody should go there.
constexpr double kLeastGain_m2 = 1.0;
/// Where no way along the edges is known, ways are taken to be so much longer than straight.
constexpr double kDetour = 1.5;

std::optional<std::size_t> index_of(const UnionGraph& all, std::optional<std::size_t> robot, std::uint64_t node) {
  for (std::size_t k = 0; k < all.members.size(); ++k) {
    if (all.members[k].robot == robot && all.members[k].node->id == node) {
      return k;
    }
  }
  return std::nullopt;
}

/// Another robot drives there, or near.
bool taken(const Point2& p_map, const ChoiceInput& input) {
  return std::any_of(input.fleet.others.begin(), input.fleet.others.end(), [&](const RobotTopology& other) {
    return other.active && other.target_map && (*other.target_map - p_map).norm() < input.node_distance_m &&
           !input.corridors.walled_off(*other.target_map, p_map);
  });
}

UnionGraph graph_of(const ChoiceInput& input) {
  return union_of(input.own, input.fleet.others, input.corridors, input.max_edge_m);
}

std::vector<PendingGoal> pending_of(const ChoiceInput& input, const UnionGraph& all, const ShortestWays& ways) {
  std::vector<PendingGoal> goals;
  for (std::size_t k = 0; k < all.members.size(); ++k) {
    if (!ways.reaches(k)) {
      continue;
    }
    for (const TopologyGoal& goal : all.members[k].node->goals) {
      if (input.left_out(goal.p_map) || taken(goal.p_map, input)) {
        continue;
      }
      PendingGoal pending;
      pending.robot = all.members[k].robot;
      pending.member = k;
      pending.node = all.members[k].node->id;
      pending.id = goal.id;
      pending.p_map = goal.p_map;
      pending.layer = goal.layer;
      pending.node_way_m = ways.distance_m[k];
      pending.way_m = ways.distance_m[k] + (goal.p_map - all.graph.places[k]).norm();
      for (const std::size_t step : ways.way_to(k)) {
        pending.way_map.push_back(all.graph.places[step]);
      }
      pending.way_map.erase(pending.way_map.begin());
      goals.push_back(std::move(pending));
    }
  }
  return goals;
}

/// Of the goals that are open to the robot and belong to the closest node the outermost, then the one with the smallest
/// turn (spec S4.1, S4.4).
std::optional<std::size_t> main_of_closest(const std::vector<PendingGoal>& goals, const std::vector<bool>& open,
                                           const Pose2& map_T_base) {
  double closest_m = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < goals.size(); ++k) {
    closest_m = open[k] ? std::min(closest_m, goals[k].node_way_m) : closest_m;
  }
  std::vector<std::size_t> of_closest;
  std::vector<GoalDirection> directions;
  for (std::size_t k = 0; k < goals.size(); ++k) {
    if (open[k] && goals[k].node_way_m <= closest_m) {
      of_closest.push_back(k);
      directions.push_back({goals[k].layer, bearing_to(map_T_base, goals[k].p_map)});
    }
  }
  const std::optional<std::size_t> main = main_goal_of(directions, 0.0);
  return main ? std::optional(of_closest[*main]) : std::nullopt;
}

/// Ways of another robot to the goals: along the edges from the node it is at.
std::vector<double> ways_of(const RobotTopology& robot, std::size_t index, const UnionGraph& all,
                            const std::vector<PendingGoal>& goals) {
  const std::optional<std::size_t> source = index_of(all, index, robot.topology.current);
  std::optional<ShortestWays> ways;
  if (source) {
    ways = bellman_ford(all.graph, *source);
  }
  std::vector<double> lengths;
  lengths.reserve(goals.size());
  for (const PendingGoal& goal : goals) {
    double way_m = kDetour * (robot.map_T_base.translation() - goal.p_map).norm();
    if (ways && ways->reaches(goal.member)) {
      way_m = ways->distance_m[goal.member] + (all.graph.places[goal.member] - goal.p_map).norm();
    }
    lengths.push_back(way_m);
  }
  return lengths;
}

/// Which goals no other active robot has a shorter way to. Of equally long ones the first robot by name has it.
std::vector<bool> nearest_to_self(const ChoiceInput& input, const UnionGraph& all,
                                  const std::vector<PendingGoal>& goals) {
  std::vector<bool> own(goals.size(), true);
  for (std::size_t k = 0; k < input.fleet.others.size(); ++k) {
    const RobotTopology& other = input.fleet.others[k];
    if (!other.active) {
      continue;
    }
    const std::vector<double> ways_m = ways_of(other, k, all, goals);
    for (std::size_t goal = 0; goal < goals.size(); ++goal) {
      const bool nearer = ways_m[goal] < goals[goal].way_m ||
                          (ways_m[goal] <= goals[goal].way_m && other.robot_id < input.fleet.robot_id);
      own[goal] = own[goal] && !nearer;
    }
  }
  return own;
}

/// Robots that have a target do not bid: it is theirs already.
std::optional<std::size_t> won(const ChoiceInput& input, const UnionGraph& all, const std::vector<PendingGoal>& goals) {
  std::vector<AuctionTask> tasks;
  Bidder self{input.fleet.robot_id, {}};
  for (const PendingGoal& goal : goals) {
    tasks.push_back({goal.p_map, kLeastGain_m2 + input.gain_m2(goal.p_map)});
    self.way_m.push_back(goal.way_m);
  }
  std::vector<Bidder> bidders{std::move(self)};
  for (std::size_t k = 0; k < input.fleet.others.size(); ++k) {
    const RobotTopology& other = input.fleet.others[k];
    if (other.active && !other.target_map) {
      bidders.push_back({other.robot_id, ways_of(other, k, all, goals)});
    }
  }
  return auction(bidders, std::move(tasks), input.auction).front();
}

ExploreDecision decision_of(const std::vector<PendingGoal>& goals, std::optional<std::size_t> chosen, std::string why) {
  ExploreDecision decision;
  decision.rule = "topological";
  decision.why = std::move(why);
  for (std::size_t k = 0; k < goals.size(); ++k) {
    const bool last = decision.candidates.size() + 1 == kMaxDecisionCandidates;
    const bool still_to_come = chosen && *chosen >= k && *chosen != k;
    if (decision.candidates.size() == kMaxDecisionCandidates || (last && still_to_come)) {
      continue;  // the chosen one has its place
    }
    if (chosen == k) {
      decision.chosen = static_cast<std::uint32_t>(decision.candidates.size());
    }
    DecisionCandidate candidate;
    candidate.map_T_base = {goals[k].p_map.x(), goals[k].p_map.y(), 0.0};
    candidate.path_m = goals[k].way_m;
    candidate.score = -goals[k].way_m;
    decision.candidates.push_back(candidate);
  }
  return decision;
}

}  // namespace

GoalChoice choose_goal(const ChoiceInput& input) {
  const UnionGraph all = graph_of(input);
  const std::optional<std::size_t> here = index_of(all, std::nullopt, input.own.current);
  SEEKER_ASSERT(here.has_value());
  const std::vector<PendingGoal> goals = pending_of(input, all, bellman_ford(all.graph, *here));
  const auto any_active = [&](bool driving) {
    return std::any_of(input.fleet.others.begin(), input.fleet.others.end(),
                       [&](const RobotTopology& other) { return other.active && (!driving || other.target_map); });
  };
  const bool others_drive = any_active(true);
  GoalChoice choice;
  std::optional<std::size_t> chosen;
  std::string why = "no goal is left";
  if (input.patient && any_active(false)) {
    chosen = main_of_closest(goals, nearest_to_self(input, all, goals), input.map_T_base);
    why = "the closest of the goals that no other robot is nearer to";
    if (!chosen) {
      chosen = won(input, all, goals);
      why = chosen ? "its share of the goals that others are nearer to" : "other robots are nearer to what is left";
    }
    choice.others_busy = !chosen && (!goals.empty() || others_drive);
    choice.others_idle = choice.others_busy && !others_drive;
  } else if (!goals.empty()) {
    chosen = main_of_closest(goals, std::vector<bool>(goals.size(), true), input.map_T_base);
    const bool at_hand = !goals[*chosen].robot && goals[*chosen].node == input.own.current;
    why = at_hand ? "the main goal of this node" : "back to the closest node with a goal";
  }
  choice.decision = decision_of(goals, chosen, std::move(why));
  if (chosen) {
    choice.goal = goals[*chosen];
  }
  return choice;
}

}  // namespace seeker::fleet
