#include "server/fleet/goal_choice.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "common/core/assert.hpp"

namespace seeker::fleet {
namespace {

/// Gain of a goal without visible unknown floor: the rules kept it, so that a robot should drive there.
constexpr double kLeastGain_m2 = 1.0;
/// Ratio of path length and straight distance where no path along the edges is known.
constexpr double kDetour = 1.5;

std::optional<std::size_t> index_of(const UnionGraph& all, std::optional<std::size_t> robot, std::uint64_t node) {
  for (std::size_t k = 0; k < all.members.size(); ++k) {
    if (all.members[k].robot == robot && all.members[k].node->id == node) {
      return k;
    }
  }
  return std::nullopt;
}

UnionGraph graph_of(const ChoiceInput& input) {
  return union_of(input.own, input.fleet.others, input.corridors, input.max_edge_m);
}

/// How far it is to places for this robot and the others, along the union's edges from the node that each is at.
class Paths {
 public:
  explicit Paths(const ChoiceInput& input) : all_(graph_of(input)), start_(input.map_T_base.translation()) {
    const std::optional<std::size_t> here = index_of(all_, std::nullopt, input.own.current);
    SEEKER_ASSERT(here.has_value());
    own_ = bellman_ford(all_.graph, *here);
    for (std::size_t k = 0; k < input.fleet.others.size(); ++k) {
      const std::optional<std::size_t> source = index_of(all_, k, input.fleet.others[k].topology.current);
      others_.push_back(source ? std::optional(bellman_ford(all_.graph, *source)) : std::nullopt);
      starts_.push_back(input.fleet.others[k].map_T_base.translation());
    }
  }

  [[nodiscard]] const UnionGraph& all() const { return all_; }
  [[nodiscard]] const ShortestPaths& own() const { return own_; }
  /// Path length to a place near node `member` of the union, which must be reachable.
  [[nodiscard]] double own_m(std::size_t member, const Point2& p_map) const {
    return own_.distance_m[member] + (p_map - all_.graph.places[member]).norm();
  }
  [[nodiscard]] double other_m(std::size_t robot, std::size_t member, const Point2& p_map) const {
    const std::optional<ShortestPaths>& paths = others_[robot];
    return paths && paths->reaches(member) ? paths->distance_m[member] + (p_map - all_.graph.places[member]).norm()
                                           : kDetour * (starts_[robot] - p_map).norm();
  }

  /// By how much the path of another robot is longer than this one's. Edges lead over the node, which a robot from
  /// elsewhere need not visit: a path is not assumed to be longer than the straight distance with a detour.
  [[nodiscard]] double lead_m(std::size_t robot, std::size_t member, const Point2& p_map) const {
    const double own = std::min(own_m(member, p_map), kDetour * (start_ - p_map).norm());
    return std::min(other_m(robot, member, p_map), kDetour * (starts_[robot] - p_map).norm()) - own;
  }

 private:
  UnionGraph all_;
  ShortestPaths own_;
  Point2 start_;
  std::vector<std::optional<ShortestPaths>> others_;
  std::vector<Point2> starts_;
};

/// Another robot drives there, or near.
bool drives_to(const RobotTopology& other, const Point2& p_map, const ChoiceInput& input) {
  return other.active && other.target_map && (*other.target_map - p_map).norm() < input.node_distance_m &&
         !input.corridors.walled_off(*other.target_map, p_map);
}

/// Another robot drives there, and is not much farther from it.
bool taken(const ChoiceInput& input, const Paths& paths, std::size_t member, const Point2& p_map) {
  for (std::size_t k = 0; k < input.fleet.others.size(); ++k) {
    if (drives_to(input.fleet.others[k], p_map, input) && paths.lead_m(k, member, p_map) <= input.takeover_m) {
      return true;
    }
  }
  return false;
}

std::vector<PendingGoal> pending_of(const ChoiceInput& input, const Paths& paths) {
  const UnionGraph& all = paths.all();
  std::vector<PendingGoal> goals;
  for (std::size_t k = 0; k < all.members.size(); ++k) {
    if (!paths.own().reaches(k)) {
      continue;
    }
    for (const TopologyGoal& goal : all.members[k].node->goals) {
      if (input.left_out(goal.p_map) || taken(input, paths, k, goal.p_map)) {
        continue;
      }
      PendingGoal pending;
      pending.robot = all.members[k].robot;
      pending.member = k;
      pending.node = all.members[k].node->id;
      pending.id = goal.id;
      pending.p_map = goal.p_map;
      pending.layer = goal.layer;
      pending.distance_to_node_m = paths.own().distance_m[k];
      pending.distance_m = paths.own_m(k, goal.p_map);
      for (const std::size_t step : paths.own().path_to(k)) {
        pending.path_map.push_back(all.graph.places[step]);
      }
      pending.path_map.erase(pending.path_map.begin());
      goals.push_back(std::move(pending));
    }
  }
  return goals;
}

/// Of the goals that belong to the closest node the outermost, then the one with the smallest heading change (spec
/// S4.1, S4.4).
std::optional<std::size_t> main_of_closest(const std::vector<PendingGoal>& goals, const Pose2& map_T_base) {
  double closest_m = std::numeric_limits<double>::infinity();
  for (const PendingGoal& goal : goals) {
    closest_m = std::min(closest_m, goal.distance_to_node_m);
  }
  std::vector<std::size_t> of_closest;
  std::vector<GoalDirection> directions;
  for (std::size_t k = 0; k < goals.size(); ++k) {
    if (goals[k].distance_to_node_m <= closest_m) {
      of_closest.push_back(k);
      directions.push_back({goals[k].layer, bearing_to(map_T_base, goals[k].p_map)});
    }
  }
  const std::optional<std::size_t> main = main_goal_of(directions, 0.0);
  return main ? std::optional(of_closest[*main]) : std::nullopt;
}

/// Of the goals that are open to the robot the one with the shortest path. A robot that shares a building keeps to what
/// is around it: the outermost goal of a node (spec S4.4) would lead it across to where the other one is.
std::optional<std::size_t> closest_of(const std::vector<PendingGoal>& goals, const std::vector<bool>& open) {
  std::optional<std::size_t> closest;
  for (std::size_t k = 0; k < goals.size(); ++k) {
    if (open[k] && (!closest || goals[k].distance_m < goals[*closest].distance_m)) {
      closest = k;
    }
  }
  return closest;
}

/// Path lengths of another robot to the goals.
std::vector<double> distances_of(std::size_t robot, const Paths& paths, const std::vector<PendingGoal>& goals) {
  std::vector<double> lengths;
  lengths.reserve(goals.size());
  for (const PendingGoal& goal : goals) {
    lengths.push_back(paths.other_m(robot, goal.member, goal.p_map));
  }
  return lengths;
}

/// The goals to which no other active robot has a shorter path. Of equally long ones the first robot by name has it.
std::vector<bool> nearest_to_self(const ChoiceInput& input, const Paths& paths, const std::vector<PendingGoal>& goals) {
  std::vector<bool> own(goals.size(), true);
  for (std::size_t k = 0; k < input.fleet.others.size(); ++k) {
    const RobotTopology& other = input.fleet.others[k];
    if (!other.active) {
      continue;
    }
    const std::vector<double> distances_m = distances_of(k, paths, goals);
    for (std::size_t goal = 0; goal < goals.size(); ++goal) {
      const bool nearer = distances_m[goal] < goals[goal].distance_m ||
                          (distances_m[goal] <= goals[goal].distance_m && other.robot_id < input.fleet.robot_id);
      own[goal] = own[goal] && !nearer;
    }
  }
  return own;
}

/// Robots that have a target do not bid: it is theirs already.
std::optional<std::size_t> won(const ChoiceInput& input, const Paths& paths, const std::vector<PendingGoal>& goals) {
  std::vector<AuctionTask> tasks;
  Bidder self{input.fleet.robot_id, {}};
  for (const PendingGoal& goal : goals) {
    tasks.push_back({goal.p_map, kLeastGain_m2 + input.gain_m2(goal.p_map)});
    self.distance_m.push_back(goal.distance_m);
  }
  std::vector<Bidder> bidders{std::move(self)};
  for (std::size_t k = 0; k < input.fleet.others.size(); ++k) {
    const RobotTopology& other = input.fleet.others[k];
    if (other.active && !other.target_map) {
      bidders.push_back({other.robot_id, distances_of(k, paths, goals)});
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
    candidate.path_m = goals[k].distance_m;
    candidate.score = -goals[k].distance_m;
    decision.candidates.push_back(candidate);
  }
  return decision;
}

}  // namespace

GoalChoice choose_goal(const ChoiceInput& input) {
  const Paths paths(input);
  const std::vector<PendingGoal> goals = pending_of(input, paths);
  const auto any_active = [&](bool driving) {
    return std::any_of(input.fleet.others.begin(), input.fleet.others.end(),
                       [&](const RobotTopology& other) { return other.active && (!driving || other.target_map); });
  };
  const bool others_drive = any_active(true);
  GoalChoice choice;
  std::optional<std::size_t> chosen;
  std::string why = "no goal is left";
  if (input.patient && any_active(false)) {
    chosen = closest_of(goals, nearest_to_self(input, paths, goals));
    why = "the closest of the goals that no other robot is nearer to";
    if (!chosen) {
      chosen = won(input, paths, goals);
      why = chosen ? "its share of the goals that others are nearer to" : "other robots are nearer to what is left";
    }
    choice.others_busy = !chosen && (!goals.empty() || others_drive);
    choice.others_idle = choice.others_busy && !others_drive;
  } else if (!goals.empty()) {
    chosen = main_of_closest(goals, input.map_T_base);
    const bool at_hand = !goals[*chosen].robot && goals[*chosen].node == input.own.current;
    why = at_hand ? "the main goal of this node" : "back to the closest node with a goal";
  }
  choice.decision = decision_of(goals, chosen, std::move(why));
  if (chosen) {
    choice.goal = goals[*chosen];
  }
  return choice;
}

bool yields(const ChoiceInput& input, const PendingGoal& goal) {
  const auto wants = [&](const RobotTopology& other) { return drives_to(other, goal.p_map, input); };
  if (std::none_of(input.fleet.others.begin(), input.fleet.others.end(), wants)) {
    return false;
  }
  const Paths paths(input);
  const std::optional<std::size_t> node = index_of(paths.all(), goal.robot, goal.node);
  if (!node || !paths.own().reaches(*node)) {
    return true;
  }
  for (std::size_t k = 0; k < input.fleet.others.size(); ++k) {
    const RobotTopology& other = input.fleet.others[k];
    const double lead_m = paths.lead_m(k, *node, goal.p_map);
    const bool first = other.robot_id < input.fleet.robot_id;
    if (wants(other) && (lead_m < -input.takeover_m || (first && lead_m <= input.takeover_m))) {
      return true;
    }
  }
  return false;
}

}  // namespace seeker::fleet
