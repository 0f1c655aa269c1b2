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

UnionGraph graph_of(const ChoiceInput& input) {
  return union_of(input.own, input.fleet.others, input.corridors, input.max_edge_m);
}

/// How far it is to places for this robot and the others, along the union's edges from the node that each is at.
class Ways {
 public:
  explicit Ways(const ChoiceInput& input) : all_(graph_of(input)), start_(input.map_T_base.translation()) {
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
  [[nodiscard]] const ShortestWays& own() const { return own_; }
  /// To a place near node `member` of the union, which there must be a way to.
  [[nodiscard]] double own_m(std::size_t member, const Point2& p_map) const {
    return own_.distance_m[member] + (p_map - all_.graph.places[member]).norm();
  }
  [[nodiscard]] double other_m(std::size_t robot, std::size_t member, const Point2& p_map) const {
    const std::optional<ShortestWays>& ways = others_[robot];
    return ways && ways->reaches(member) ? ways->distance_m[member] + (p_map - all_.graph.places[member]).norm()
                                         : kDetour * (starts_[robot] - p_map).norm();
  }

  /// By how much the way of another robot is longer than this one's. Edges lead by way of the node, where a robot that
  /// comes from elsewhere need not go: a way is not taken to be longer than straight with a detour.
  [[nodiscard]] double lead_m(std::size_t robot, std::size_t member, const Point2& p_map) const {
    const double own = std::min(own_m(member, p_map), kDetour * (start_ - p_map).norm());
    return std::min(other_m(robot, member, p_map), kDetour * (starts_[robot] - p_map).norm()) - own;
  }

 private:
  UnionGraph all_;
  ShortestWays own_;
  Point2 start_;
  std::vector<std::optional<ShortestWays>> others_;
  std::vector<Point2> starts_;
};

/// Another robot drives there, or near.
bool drives_to(const RobotTopology& other, const Point2& p_map, const ChoiceInput& input) {
  return other.active && other.target_map && (*other.target_map - p_map).norm() < input.node_distance_m &&
         !input.corridors.walled_off(*other.target_map, p_map);
}

/// Another robot drives there, and is not much farther from it.
bool taken(const ChoiceInput& input, const Ways& ways, std::size_t member, const Point2& p_map) {
  for (std::size_t k = 0; k < input.fleet.others.size(); ++k) {
    if (drives_to(input.fleet.others[k], p_map, input) && ways.lead_m(k, member, p_map) <= input.takeover_m) {
      return true;
    }
  }
  return false;
}

std::vector<PendingGoal> pending_of(const ChoiceInput& input, const Ways& ways) {
  const UnionGraph& all = ways.all();
  std::vector<PendingGoal> goals;
  for (std::size_t k = 0; k < all.members.size(); ++k) {
    if (!ways.own().reaches(k)) {
      continue;
    }
    for (const TopologyGoal& goal : all.members[k].node->goals) {
      if (input.left_out(goal.p_map) || taken(input, ways, k, goal.p_map)) {
        continue;
      }
      PendingGoal pending;
      pending.robot = all.members[k].robot;
      pending.member = k;
      pending.node = all.members[k].node->id;
      pending.id = goal.id;
      pending.p_map = goal.p_map;
      pending.layer = goal.layer;
      pending.node_way_m = ways.own().distance_m[k];
      pending.way_m = ways.own_m(k, goal.p_map);
      for (const std::size_t step : ways.own().way_to(k)) {
        pending.way_map.push_back(all.graph.places[step]);
      }
      pending.way_map.erase(pending.way_map.begin());
      goals.push_back(std::move(pending));
    }
  }
  return goals;
}

/// Of the goals that belong to the closest node the outermost, then the one with the smallest turn (spec S4.1, S4.4).
std::optional<std::size_t> main_of_closest(const std::vector<PendingGoal>& goals, const Pose2& map_T_base) {
  double closest_m = std::numeric_limits<double>::infinity();
  for (const PendingGoal& goal : goals) {
    closest_m = std::min(closest_m, goal.node_way_m);
  }
  std::vector<std::size_t> of_closest;
  std::vector<GoalDirection> directions;
  for (std::size_t k = 0; k < goals.size(); ++k) {
    if (goals[k].node_way_m <= closest_m) {
      of_closest.push_back(k);
      directions.push_back({goals[k].layer, bearing_to(map_T_base, goals[k].p_map)});
    }
  }
  const std::optional<std::size_t> main = main_goal_of(directions, 0.0);
  return main ? std::optional(of_closest[*main]) : std::nullopt;
}

/// Of the goals that are open to the robot the one with the shortest way. A robot that shares a building keeps to what
/// is around it: the outermost goal of a node (spec S4.4) would lead it across to where the other one is.
std::optional<std::size_t> closest_of(const std::vector<PendingGoal>& goals, const std::vector<bool>& open) {
  std::optional<std::size_t> closest;
  for (std::size_t k = 0; k < goals.size(); ++k) {
    if (open[k] && (!closest || goals[k].way_m < goals[*closest].way_m)) {
      closest = k;
    }
  }
  return closest;
}

/// Ways of another robot to the goals.
std::vector<double> ways_of(std::size_t robot, const Ways& ways, const std::vector<PendingGoal>& goals) {
  std::vector<double> lengths;
  lengths.reserve(goals.size());
  for (const PendingGoal& goal : goals) {
    lengths.push_back(ways.other_m(robot, goal.member, goal.p_map));
  }
  return lengths;
}

/// Which goals no other active robot has a shorter way to. Of equally long ones the first robot by name has it.
std::vector<bool> nearest_to_self(const ChoiceInput& input, const Ways& ways, const std::vector<PendingGoal>& goals) {
  std::vector<bool> own(goals.size(), true);
  for (std::size_t k = 0; k < input.fleet.others.size(); ++k) {
    const RobotTopology& other = input.fleet.others[k];
    if (!other.active) {
      continue;
    }
    const std::vector<double> ways_m = ways_of(k, ways, goals);
    for (std::size_t goal = 0; goal < goals.size(); ++goal) {
      const bool nearer = ways_m[goal] < goals[goal].way_m ||
                          (ways_m[goal] <= goals[goal].way_m && other.robot_id < input.fleet.robot_id);
      own[goal] = own[goal] && !nearer;
    }
  }
  return own;
}

/// Robots that have a target do not bid: it is theirs already.
std::optional<std::size_t> won(const ChoiceInput& input, const Ways& ways, const std::vector<PendingGoal>& goals) {
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
      bidders.push_back({other.robot_id, ways_of(k, ways, goals)});
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
  const Ways ways(input);
  const std::vector<PendingGoal> goals = pending_of(input, ways);
  const auto any_active = [&](bool driving) {
    return std::any_of(input.fleet.others.begin(), input.fleet.others.end(),
                       [&](const RobotTopology& other) { return other.active && (!driving || other.target_map); });
  };
  const bool others_drive = any_active(true);
  GoalChoice choice;
  std::optional<std::size_t> chosen;
  std::string why = "no goal is left";
  if (input.patient && any_active(false)) {
    chosen = closest_of(goals, nearest_to_self(input, ways, goals));
    why = "the closest of the goals that no other robot is nearer to";
    if (!chosen) {
      chosen = won(input, ways, goals);
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
  const Ways ways(input);
  const std::optional<std::size_t> node = index_of(ways.all(), goal.robot, goal.node);
  if (!node || !ways.own().reaches(*node)) {
    return true;
  }
  for (std::size_t k = 0; k < input.fleet.others.size(); ++k) {
    const RobotTopology& other = input.fleet.others[k];
    const double lead_m = ways.lead_m(k, *node, goal.p_map);
    const bool first = other.robot_id < input.fleet.robot_id;
    if (wants(other) && (lead_m < -input.takeover_m || (first && lead_m <= input.takeover_m))) {
      return true;
    }
  }
  return false;
}

}  // namespace seeker::fleet
