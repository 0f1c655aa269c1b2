#include "server/fleet/topology_map.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "common/core/assert.hpp"

namespace seeker::fleet {
namespace {

FreeSector sector_of(const SpaceSection& section, const Pose2& node_T_base, const Pose2& base_T_laser) {
  FreeSector sector;
  sector.from_base = node_T_base * base_T_laser.translation();
  sector.start_rad = wrap_angle(section.start_rad + node_T_base.theta_rad);
  sector.span_rad = section.span_rad;
  sector.radius_m = section.radius_m;
  return sector;
}

bool has_edge(const Topology& map, std::uint64_t a, std::uint64_t b) {
  return std::any_of(map.edges.begin(), map.edges.end(), [&](const TopologyEdge& edge) {
    return (edge.a == a && edge.b == b) || (edge.a == b && edge.b == a);
  });
}

/// Whether some node has taken the region of a place.
bool near_node_of(const Topology& topology, const Point2& p_map, const Corridors& corridors, double node_distance_m) {
  return std::any_of(topology.nodes.begin(), topology.nodes.end(), [&](const TopologyNode& node) {
    return (node.map_T_base.translation() - p_map).norm() < node_distance_m && joined(node, p_map, corridors);
  });
}

}  // namespace

TopologyMap::TopologyMap(const TopologyParams& params, Topology kept, std::vector<Point2> closed_map)
    : params_(params), map_(std::move(kept)), closed_map_(std::move(closed_map)) {
  for (const TopologyNode& node : map_.nodes) {
    next_node_ = std::max(next_node_, node.id + 1);
    for (const TopologyGoal& goal : node.goals) {
      next_goal_ = std::max(next_goal_, goal.id + 1);
    }
  }
}

const TopologyNode* TopologyMap::find(std::uint64_t node) const {
  const auto at = std::find_if(map_.nodes.begin(), map_.nodes.end(),
                               [node](const TopologyNode& candidate) { return candidate.id == node; });
  return at == map_.nodes.end() ? nullptr : &*at;
}

TopologyNode& TopologyMap::present() {
  const auto at = std::find_if(map_.nodes.begin(), map_.nodes.end(),
                               [this](const TopologyNode& node) { return node.id == map_.current; });
  SEEKER_ASSERT(at != map_.nodes.end());
  return *at;
}

void TopologyMap::join(std::uint64_t a, std::uint64_t b) {
  if (a != 0 && b != 0 && a != b && !has_edge(map_, a, b)) {
    map_.edges.push_back({a, b});
  }
}

std::vector<RuledGoal> TopologyMap::create(const Pose2& map_T_base, const SpaceTree& tree,
                                           const std::vector<RobotTopology>& others, const Corridors& corridors) {
  TopologyNode node;
  node.id = next_node_++;
  node.map_T_base = map_T_base;
  join(map_.current, node.id);
  for (const TopologyNode& known : map_.nodes) {
    const double d_m = distance_m(known.map_T_base, map_T_base);
    if (d_m <= params_.max_edge_m && corridors.free(map_T_base.translation(), known.map_T_base.translation())) {
      join(known.id, node.id);
    }
  }
  map_.current = node.id;
  map_.nodes.push_back(std::move(node));
  std::vector<RuledGoal> ruled = add_tree(map_T_base, tree, others, corridors);
  rebind(corridors);
  settle(others, corridors);
  return ruled;
}

std::vector<RuledGoal> TopologyMap::look_again(const Pose2& map_T_base, const SpaceTree& tree,
                                               const std::vector<RobotTopology>& others, const Corridors& corridors) {
  return add_tree(map_T_base, tree, others, corridors);
}

std::vector<RuledGoal> TopologyMap::add_tree(const Pose2& map_T_base, const SpaceTree& tree,
                                             const std::vector<RobotTopology>& others, const Corridors& corridors) {
  TopologyNode& node = present();
  const Pose2 node_T_base = inverse(node.map_T_base) * map_T_base;
  for (const SpaceSection& section : tree.sections) {
    node.sectors.push_back(sector_of(section, node_T_base, tree.base_T_laser));
  }
  std::vector<RuledGoal> goals;
  goals.reserve(tree.goals.size());
  for (const SpaceGoal& goal : tree.goals) {
    goals.push_back({map_T_base * goal.p_base, goal.layer, 0});
  }
  goals = apply_rules(std::move(goals), {node, map_, others, closed_map_, corridors, params_.node_distance_m});
  for (const RuledGoal& goal : goals) {
    if (goal.kept()) {
      node.goals.push_back({next_goal_++, goal.p_map, goal.layer});
    }
  }
  return goals;
}

/// Rule 5: pending goals go to the present node where it is nearer and a corridor leads there.
void TopologyMap::rebind(const Corridors& corridors) {
  TopologyNode& here = present();
  for (TopologyNode& node : map_.nodes) {
    if (node.id == here.id) {
      continue;
    }
    const auto moves = [&](const TopologyGoal& goal) {
      return (goal.p_map - here.map_T_base.translation()).norm() <
                 (goal.p_map - node.map_T_base.translation()).norm() &&
             joined(here, goal.p_map, corridors);
    };
    const auto stay = std::stable_partition(node.goals.begin(), node.goals.end(),
                                            [&](const TopologyGoal& goal) { return !moves(goal); });
    here.goals.insert(here.goals.end(), stay, node.goals.end());
    node.goals.erase(stay, node.goals.end());
  }
}

std::optional<std::uint64_t> TopologyMap::node_at(const Point2& p_map, const Corridors& corridors) const {
  std::optional<std::uint64_t> best;
  double best_m = params_.node_distance_m;
  for (const TopologyNode& node : map_.nodes) {
    const double d_m = (node.map_T_base.translation() - p_map).norm();
    if (d_m < best_m && joined(node, p_map, corridors)) {
      best = node.id;
      best_m = d_m;
    }
  }
  return best;
}

void TopologyMap::arrive(std::uint64_t node) {
  SEEKER_ASSERT(find(node) != nullptr);
  join(map_.current, node);
  map_.current = node;
}

void TopologyMap::settle(const std::vector<RobotTopology>& others, const Corridors& corridors) {
  for (TopologyNode& node : map_.nodes) {
    node.goals.erase(
        std::remove_if(node.goals.begin(), node.goals.end(),
                       [&](const TopologyGoal& goal) { return has_node_near(goal.p_map, others, corridors); }),
        node.goals.end());
  }
}

bool TopologyMap::has_node_near(const Point2& p_map, const std::vector<RobotTopology>& others,
                                const Corridors& corridors) const {
  return near_node_of(map_, p_map, corridors, params_.node_distance_m) ||
         std::any_of(others.begin(), others.end(), [&](const RobotTopology& other) {
           return near_node_of(other.topology, p_map, corridors, params_.node_distance_m);
         });
}

void TopologyMap::close(std::uint64_t goal) {
  for (TopologyNode& node : map_.nodes) {
    const auto at = std::find_if(node.goals.begin(), node.goals.end(),
                                 [goal](const TopologyGoal& candidate) { return candidate.id == goal; });
    if (at != node.goals.end()) {
      closed_map_.push_back(at->p_map);
      node.goals.erase(at);
      return;
    }
  }
}

bool TopologyMap::has(std::uint64_t goal) const {
  return std::any_of(map_.nodes.begin(), map_.nodes.end(), [goal](const TopologyNode& node) {
    return std::any_of(node.goals.begin(), node.goals.end(),
                       [goal](const TopologyGoal& candidate) { return candidate.id == goal; });
  });
}

Topology moved(Topology topology, const MapMove& move) {
  for (TopologyNode& node : topology.nodes) {
    node.map_T_base = move * node.map_T_base;
    for (TopologyGoal& goal : node.goals) {
      goal.p_map = move * goal.p_map;
    }
  }
  return topology;
}

RobotTopology moved(RobotTopology robot, const MapMove& move) {
  robot.map_T_base = move * robot.map_T_base;
  robot.topology = moved(std::move(robot.topology), move);
  if (robot.target_map) {
    robot.target_map = move * *robot.target_map;
  }
  return robot;
}

void TopologyMap::transform(const MapMove& move) {
  map_ = moved(std::move(map_), move);
  for (Point2& p_map : closed_map_) {
    p_map = move * p_map;
  }
}

UnionGraph union_of(const Topology& own, const std::vector<RobotTopology>& others, const Corridors& corridors,
                    double max_edge_m) {
  UnionGraph all;
  const auto add = [&](const Topology& topology, std::optional<std::size_t> robot) {
    std::map<std::uint64_t, std::size_t> index;
    for (const TopologyNode& node : topology.nodes) {
      index.emplace(node.id, all.members.size());
      all.members.push_back({robot, &node});
      all.graph.places.push_back(node.map_T_base.translation());
    }
    for (const TopologyEdge& edge : topology.edges) {
      if (index.contains(edge.a) && index.contains(edge.b)) {
        all.graph.edges.push_back({index.at(edge.a), index.at(edge.b)});
      }
    }
  };
  add(own, std::nullopt);
  for (std::size_t robot = 0; robot < others.size(); ++robot) {
    add(others[robot].topology, robot);
  }
  for (std::size_t a = 0; a < all.members.size(); ++a) {
    for (std::size_t b = std::max(a + 1, own.nodes.size()); b < all.members.size(); ++b) {
      const Point2& p = all.graph.places[a];
      const Point2& q = all.graph.places[b];
      if (all.members[a].robot != all.members[b].robot && (p - q).norm() <= max_edge_m &&
          (joined(*all.members[a].node, q, corridors) || joined(*all.members[b].node, p, corridors))) {
        all.graph.edges.push_back({a, b});
      }
    }
  }
  return all;
}

}  // namespace seeker::fleet
