/// \file
/// Hierarchical topology map (spec S4.2) and the rules that decide which possible goals are worth keeping (spec S4.3).
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
  double node_distance_m = 2.0;  ///< V_R: how near two nodes, or a node and a goal, are the same region
  double max_edge_m = 8.0;       ///< nodes farther apart are not joined by sight
};

/// What the map of the moment says about the straight strip of a width between two places.
enum class Corridor : std::uint8_t {
  kFree,
  kUnknown,  ///< some of it has not been seen, nothing of it is known to be blocked
  kBlocked,
};
using CorridorTest = std::function<Corridor(const Point2& from_map, const Point2& to_map, double width_m)>;
/// The test over a cost map, which must outlive it. Within half the width of either end only the middle line counts.
[[nodiscard]] CorridorTest corridors_of(const nav::CostMap& map);

/// The map as the rules ask for it.
struct Corridors {
  CorridorTest test;
  double width_m = 0.70;  ///< W

  [[nodiscard]] bool free(const Point2& from_map, const Point2& to_map) const {
    return test(from_map, to_map, width_m) == Corridor::kFree;
  }
  /// Something is known to stand between the two places.
  [[nodiscard]] bool walled_off(const Point2& from_map, const Point2& to_map) const {
    return test(from_map, to_map, 0.0) == Corridor::kBlocked;
  }
};

/// C(p, T) of spec S4.3: a corridor is free by the node's own space tree, or by the map.
[[nodiscard]] bool joined(const TopologyNode& node, const Point2& p_map, const Corridors& corridors);

/// A possible goal and what the rules made of it.
struct RuledGoal {
  Point2 p_map = Point2::Zero();
  int layer = 1;
  int rule = 0;  ///< 1, 2, 3: dropped by it; 4: kept by it; 0: no rule speaks of it, kept

  [[nodiscard]] bool kept() const { return rule == 0 || rule == 4; }
};

/// Rules 1, 4, 2 and 3 over the goals of a new tree at `present` against what all robots know; in the order in which
/// main goals are chosen, so that of two new goals near to each other the better one stays. Against the paper, rule 3
/// does not drop a goal when a wall is known to stand between it and the pending one: they are of two rooms.
struct RuleInput {
  const TopologyNode& present;
  const Topology& own;
  const std::vector<RobotTopology>& others;
  const std::vector<Point2>& closed_map;  ///< goals that were given up; they count as pending
  const Corridors& corridors;
  double node_distance_m = 2.0;  ///< V_R
};
[[nodiscard]] std::vector<RuledGoal> apply_rules(std::vector<RuledGoal> goals, const RuleInput& input);

/// The same places in another frame.
[[nodiscard]] Topology moved(Topology topology, const MapMove& move);
[[nodiscard]] RobotTopology moved(RobotTopology robot, const MapMove& move);

/// One robot's topology; ids count from 1. Not thread-safe.
class TopologyMap {
 public:
  explicit TopologyMap(const TopologyParams& params) : params_(params) {}
  /// Goes on from what was kept; ids count on above those in it.
  TopologyMap(const TopologyParams& params, Topology kept, std::vector<Point2> closed_map);

  [[nodiscard]] const Topology& topology() const { return map_; }
  [[nodiscard]] const TopologyNode* current() const { return find(map_.current); }
  [[nodiscard]] const TopologyNode* find(std::uint64_t node) const;

  /// A node at the robot, joined with the one it comes from and with those in sight; its goals are those of the tree
  /// that the rules keep, and those of other nodes that are nearer to it now (rule 5). What the rules said.
  std::vector<RuledGoal> create(const Pose2& map_T_base, const SpaceTree& tree,
                                const std::vector<RobotTopology>& others, const Corridors& corridors);
  /// The robot stands at the present node but looks elsewhere: the tree of that look is added to the node.
  std::vector<RuledGoal> look_again(const Pose2& map_T_base, const SpaceTree& tree,
                                    const std::vector<RobotTopology>& others, const Corridors& corridors);
  /// The nearest node within V_R that the robot could drive straight to; nothing where it is at no node.
  [[nodiscard]] std::optional<std::uint64_t> node_at(const Point2& p_map, const Corridors& corridors) const;
  /// The robot came to a node that was there already.
  void arrive(std::uint64_t node);
  /// Drops goals whose region has got a node of any robot since (rules 1 and 2 for goals that are pending).
  void settle(const std::vector<RobotTopology>& others, const Corridors& corridors);
  /// Whether the region of a place has a node of any robot.
  [[nodiscard]] bool has_node_near(const Point2& p_map, const std::vector<RobotTopology>& others,
                                   const Corridors& corridors) const;
  /// Nobody need go there any more, nor to what a later tree shows within V_R of it.
  void close(std::uint64_t goal);
  [[nodiscard]] bool has(std::uint64_t goal) const;
  /// Goals that were given up.
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

/// Nodes of all robots in one graph. Edges are those of each robot, and between two robots' nodes where a straight way
/// of at most `max_edge_m` is passable.
struct UnionGraph {
  struct Member {
    std::optional<std::size_t> robot;  ///< index into the others; nothing: own
    const TopologyNode* node = nullptr;
  };
  std::vector<Member> members;  ///< own first; pointers into what it was made from
  PlaceGraph graph;             ///< same order
};
[[nodiscard]] UnionGraph union_of(const Topology& own, const std::vector<RobotTopology>& others,
                                  const Corridors& corridors, double max_edge_m);

/// Of the places of a way those that can be driven straight to, the farthest from the robot (spec S4.4, eq (2)); the
/// first one where none can. Nothing for an empty way.
[[nodiscard]] std::optional<Point2> farthest_visible(const Point2& robot_map, const std::vector<Point2>& way_map,
                                                     const Corridors& corridors);

}  // namespace seeker::fleet
