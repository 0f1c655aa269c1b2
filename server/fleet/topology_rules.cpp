#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "server/fleet/topology_map.hpp"

namespace seeker::fleet {
namespace {

/// What the goals of a new tree are held against.
struct Known {
  std::vector<const TopologyNode*> nodes;  ///< of all robots, the present one apart
  std::vector<Point2> pending_map;         ///< goals of all robots
};

void add(const Topology& topology, std::uint64_t but, Known& known) {
  for (const TopologyNode& node : topology.nodes) {
    if (node.id != but) {
      known.nodes.push_back(&node);
    }
    for (const TopologyGoal& goal : node.goals) {
      known.pending_map.push_back(goal.p_map);
    }
  }
}

/// Rules 4 and 2: near a node that can be reached from it, the region has a node; near and walled off, it has not.
int rule_of_nodes(const Point2& p_map, const Known& known, const Corridors& corridors, double node_distance_m) {
  int rule = 0;
  for (const TopologyNode* node : known.nodes) {
    if ((p_map - node->map_T_base.translation()).norm() < node_distance_m) {
      if (joined(*node, p_map, corridors)) {
        return 2;
      }
      rule = 4;
    }
  }
  return rule;
}

bool is_pending(const Point2& p_map, const Known& known, const Corridors& corridors, double node_distance_m) {
  return std::any_of(known.pending_map.begin(), known.pending_map.end(), [&](const Point2& q_map) {
    return (p_map - q_map).norm() < node_distance_m && !corridors.walled_off(p_map, q_map);
  });
}

}  // namespace

bool joined(const TopologyNode& node, const Point2& p_map, const Corridors& corridors) {
  const Point2 p_base = inverse(node.map_T_base) * p_map;
  const bool by_tree = std::any_of(node.sectors.begin(), node.sectors.end(), [&](const FreeSector& sector) {
    const Point2 d = p_base - sector.from_base;
    const double into_rad = wrap_angle(std::atan2(d.y(), d.x()) - sector.start_rad - 0.5 * sector.span_rad);
    return d.norm() <= sector.radius_m && std::abs(into_rad) <= 0.5 * sector.span_rad;
  });
  return by_tree || corridors.free(node.map_T_base.translation(), p_map);
}

std::vector<RuledGoal> apply_rules(std::vector<RuledGoal> goals, const RuleInput& input) {
  Known known;
  add(input.own, input.present.id, known);
  for (const RobotTopology& other : input.others) {
    add(other.topology, 0, known);
  }
  known.pending_map.insert(known.pending_map.end(), input.closed_map.begin(), input.closed_map.end());
  const Pose2& map_T_base = input.present.map_T_base;
  const auto rotation_rad = [&](const RuledGoal& goal) { return std::abs(bearing_to(map_T_base, goal.p_map)); };
  std::stable_sort(goals.begin(), goals.end(), [&](const RuledGoal& a, const RuledGoal& b) {
    return a.layer != b.layer ? a.layer > b.layer : rotation_rad(a) < rotation_rad(b);
  });
  for (RuledGoal& goal : goals) {
    if ((goal.p_map - map_T_base.translation()).norm() < input.node_distance_m) {
      goal.rule = 1;
      continue;
    }
    goal.rule = rule_of_nodes(goal.p_map, known, input.corridors, input.node_distance_m);
    if (goal.rule != 2 && is_pending(goal.p_map, known, input.corridors, input.node_distance_m)) {
      goal.rule = 3;
    }
    if (goal.kept()) {
      known.pending_map.push_back(goal.p_map);
    }
  }
  return goals;
}

std::optional<Point2> farthest_visible(const Point2& robot_map, const std::vector<Point2>& path_map,
                                       const Corridors& corridors) {
  if (path_map.empty()) {
    return std::nullopt;
  }
  Point2 best = path_map.front();
  double best_m = -1.0;
  for (const Point2& p_map : path_map) {
    const double d_m = (p_map - robot_map).norm();
    if (d_m > best_m && corridors.free(robot_map, p_map)) {
      best = p_map;
      best_m = d_m;
    }
  }
  return best;
}

}  // namespace seeker::fleet
