/// \file
/// Which pending goal comes next: that of the present node, else that of the closest node that has one (spec S4.4);
/// with other robots on their way too, the closest that none of them is nearer to, else the one that an auction gives.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/core/explore_decision.hpp"
#include "server/fleet/auction.hpp"
#include "server/fleet/topology_map.hpp"

namespace seeker::fleet {

/// A goal of the union, with the way there.
struct PendingGoal {
  std::optional<std::size_t> robot;  ///< whose it is: index into the others; nothing: own
  std::uint64_t node = 0;            ///< that it is bound to
  std::uint64_t id = 0;
  Point2 p_map = Point2::Zero();
  int layer = 1;
  std::size_t member = 0;       ///< its node in the union graph
  double way_m = 0.0;           ///< along the topology's edges, then straight
  double node_way_m = 0.0;      ///< to its node
  std::vector<Point2> way_map;  ///< nodes from the present one (left out) to that of the goal
};

struct ChoiceInput {
  const Topology& own;
  const FleetView& fleet;
  Pose2 map_T_base;
  const Corridors& corridors;
  double max_edge_m = 8.0;
  double node_distance_m = 2.0;                        ///< V_R
  std::function<bool(const Point2& p_map)> left_out;   ///< goals not to be tried now
  std::function<double(const Point2& p_map)> gain_m2;  ///< unknown floor that a place would show
  AuctionParams auction;
  bool patient = true;      ///< leaves to others what they are nearer to
  double takeover_m = 3.0;  ///< a goal that another robot drives to is taken over where the way is so much shorter
};

struct GoalChoice {
  std::optional<PendingGoal> goal;
  bool others_busy = false;  ///< of no goal: other robots are at what is left
  bool others_idle = false;  ///< and none of them drives to any of it
  ExploreDecision decision;
};

/// Among the goals of all robots that a way along the union's edges leads to, those near another active robot's target
/// left out. The robot must be at a node.
[[nodiscard]] GoalChoice choose_goal(const ChoiceInput& input);

/// Whether a robot that drives to a goal leaves it to another one that does, too: to one with a much shorter way, and
/// of those with about the same to the first by name. The robot must be at a node.
[[nodiscard]] bool yields(const ChoiceInput& input, const PendingGoal& goal);

}  // namespace seeker::fleet
