/// \file
/// Choice of the next pending goal: that of the present node, else that of the closest node that has one (spec S4.4);
/// with other active robots the closest to which none of them is nearer, else the one assigned by an auction.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/core/explore_decision.hpp"
#include "server/fleet/auction.hpp"
#include "server/fleet/topology_map.hpp"

namespace seeker::fleet {

/// A goal of the union graph with the path to it.
struct PendingGoal {
  std::optional<std::size_t> robot;  ///< robot that owns the goal: index into the others; no value: own
  std::uint64_t node = 0;            ///< node to which the goal is bound
  std::uint64_t id = 0;
  Point2 p_map = Point2::Zero();
  int layer = 1;
  std::size_t member = 0;           ///< index of its node in the union graph
  double distance_m = 0.0;          ///< path length along the topology's edges, then straight
  double distance_to_node_m = 0.0;  ///< path length to its node
  std::vector<Point2> path_map;     ///< nodes from the present one (left out) to that of the goal
};

struct ChoiceInput {
  const Topology& own;
  const FleetView& fleet;
  Pose2 map_T_base;
  const Corridors& corridors;
  double max_edge_m = 8.0;
  double node_distance_m = 2.0;                        ///< V_R, radius of the region of a node
  std::function<bool(const Point2& p_map)> left_out;   ///< whether a goal is excluded now
  std::function<double(const Point2& p_map)> gain_m2;  ///< area of unknown floor visible from a position
  AuctionParams auction;
  bool patient = true;  ///< leave goals to robots that are nearer to them
  /// Difference of the path lengths from which on a goal is taken over from another robot.
  double takeover_m = 3.0;
};

struct GoalChoice {
  std::optional<PendingGoal> goal;
  bool others_busy = false;  ///< without a goal: other robots are nearer to the remaining goals
  bool others_idle = false;  ///< and none of them drives to any of these
  ExploreDecision decision;
};

/// Chooses among the goals of all robots that are reachable along the union's edges, without those near another active
/// robot's target. The robot must be at a node.
[[nodiscard]] GoalChoice choose_goal(const ChoiceInput& input);

/// Whether the robot leaves its present goal to another one that drives to it, too: to one with a much shorter path,
/// and with about equal paths to the first by name. The robot must be at a node.
[[nodiscard]] bool yields(const ChoiceInput& input, const PendingGoal& goal);

}  // namespace seeker::fleet
