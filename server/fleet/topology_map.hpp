/// \file
/// Hierarchical topology map (spec S4.2) and the rules by which possible goals are kept (spec S4.3).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "common/core/map_move.hpp"
#include "common/core/topology.hpp"
#include "server/fleet/bellman_ford.hpp"
#include "server/fleet/space_tree.hpp"
#include "server/nav/cost_map.hpp"

namespace seeker::fleet {

struct TopologyParams {
  SpaceTreeParams tree;
  /// V_R: distance below which two nodes, or a node and a goal, belong to the same region
  double node_distance_m = 2.0;
  double max_edge_m = 8.0;  ///< nodes farther apart are not joined by line of sight
};

/// State of the straight strip of a given width between two positions, according to the present map.
enum class Corridor : std::uint8_t {
  kFree,
  kUnknown,  ///< part of it has not been observed, no part is known to be blocked
  kBlocked,
};
using CorridorTest = std::function<Corridor(const Point2& from_map, const Point2& to_map, double width_m)>;
/// The test over a cost map, which must outlive it. Within half the width of either end only the middle line counts.
[[nodiscard]] CorridorTest corridors_of(const nav::CostMap& map);

/// The map in the form in which the rules use it.
struct Corridors {
  CorridorTest test;
  double width_m = 0.70;  ///< W

  [[nodiscard]] bool free(const Point2& from_map, const Point2& to_map) const {
    return test(from_map, to_map, width_m) == Corridor::kFree;
  }
  /// Whether an obstacle is known between the two positions.
  [[nodiscard]] bool walled_off(const Point2& from_map, const Point2& to_map) const {
    return test(from_map, to_map, 0.0) == Corridor::kBlocked;
  }
};

/// C(p, T) of spec S4.3: whether a corridor is free by the node's own space tree, or by the map.
[[nodiscard]] bool joined(const TopologyNode& node, const Point2& p_map, const Corridors& corridors);

/// A possible goal with the result of the rules.
struct RuledGoal {
  Point2 p_map = Point2::Zero();
  int layer = 1;
  int rule = 0;  ///< 1, 2, 3: dropped by this rule; 4: kept by it; 0: kept, since no rule applies

  [[nodiscard]] bool kept() const { return rule == 0 || rule == 4; }
};

/// Applies rules 1, 4, 2 and 3 to the goals of a new tree at `present`, given the topologies of all robots, in the
/// order in which main goals are chosen, so that of two new goals near each other the better one is kept. Unlike in the
/// paper, rule 3 does not drop a goal when a wall is known between it and the pending one, since they are in different
/// rooms.
struct RuleInput {
  const TopologyNode& present;
  const Topology& own;
  const std::vector<RobotTopology>& others;
  const std::vector<Point2>& closed_map;  ///< goals that were given up; they count as pending
  const Corridors& corridors;
  double node_distance_m = 2.0;  ///< V_R
};
[[nodiscard]] std::vector<RuledGoal> apply_rules(std::vector<RuledGoal> goals, const RuleInput& input);

/// Transforms a topology into another frame.
[[nodiscard]] Topology moved(Topology topology, const MapMove& move);
[[nodiscard]] RobotTopology moved(RobotTopology robot, const MapMove& move);

/// One robot's topology; ids begin at 1. Not thread-safe.
class TopologyMap {
 public:
  explicit TopologyMap(const TopologyParams& params) : params_(params) {}
  /// Continues a stored topology; new ids are above those in it.
  TopologyMap(const TopologyParams& params, Topology kept, std::vector<Point2> closed_map);

  [[nodiscard]] const Topology& topology() const { return map_; }
  [[nodiscard]] const TopologyNode* current() const { return find(map_.current); }
  [[nodiscard]] const TopologyNode* find(std::uint64_t node) const;

  /// Creates a node at the robot, joined with the previous one and with those in line of sight; its goals are those of
  /// the tree that the rules keep, and those of other nodes that are now nearer to it (rule 5). Returns the results of
  /// the rules.
  std::vector<RuledGoal> create(const Pose2& map_T_base, const SpaceTree& tree,
                                const std::vector<RobotTopology>& others, const Corridors& corridors);
  /// Adds a further space tree to the present node, observed with another heading.
  std::vector<RuledGoal> look_again(const Pose2& map_T_base, const SpaceTree& tree,
                                    const std::vector<RobotTopology>& others, const Corridors& corridors);
  /// The nearest node within V_R to which the robot could drive straight; no value where it is at no node.
  [[nodiscard]] std::optional<std::uint64_t> node_at(const Point2& p_map, const Corridors& corridors) const;
  /// Sets the present node to an existing one.
  void arrive(std::uint64_t node);
  /// Drops pending goals whose region has got a node of any robot meanwhile (rules 1 and 2).
  void settle(const std::vector<RobotTopology>& others, const Corridors& corridors);
  /// Whether the region of a position has a node of any robot.
  [[nodiscard]] bool has_node_near(const Point2& p_map, const std::vector<RobotTopology>& others,
                                   const Corridors& corridors) const;
  /// Closes a goal: neither it nor goals of later trees within V_R of it are pursued any more.
  void close(std::uint64_t goal);
  [[nodiscard]] bool has(std::uint64_t goal) const;
  /// The goals that were given up.
  [[nodiscard]] const std::vector<Point2>& closed_map() const { return closed_map_; }
  void transform(const MapMove& move);

 private:
  [[nodiscard]] TopologyNode& present();
  std::vector<RuledGoal> add_tree(const Pose2& map_T_base, const SpaceTree& tree,
                                  const std::vector<RobotTopology>& others, const Corridors& corridors);
  void rebind(const Corridors& corridors);
  void join(std::uint64_t a, std::uint64_t b);

  TopologyParams params_;
  Topology map_;
  std::vector<Point2> closed_map_;
  std::uint64_t next_node_ = 1;
  std::uint64_t next_goal_ = 1;
};

/// Nodes of all robots in one graph. Edges are those of each robot, and between two robots' nodes straight passable
/// lines of at most `max_edge_m`.
struct UnionGraph {
  struct Member {
    std::optional<std::size_t> robot;  ///< index into the others; no value: own
    const TopologyNode* node = nullptr;
  };
  std::vector<Member> members;  ///< own first; pointers into the given topologies
  PlaceGraph graph;             ///< in the same order
};
[[nodiscard]] UnionGraph union_of(const Topology& own, const std::vector<RobotTopology>& others,
                                  const Corridors& corridors, double max_edge_m);

/// Of the positions of a path to which the robot could drive straight, the farthest from the robot (spec S4.4, eq (2));
/// the first one where there is none. No value for an empty path.
[[nodiscard]] std::optional<Point2> farthest_visible(const Point2& robot_map, const std::vector<Point2>& path_map,
                                                     const Corridors& corridors);

}  // namespace seeker::fleet
