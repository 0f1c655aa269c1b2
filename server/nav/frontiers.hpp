/// \file
/// Where known free floor meets the unknown.
#pragma once

#include <vector>

#include "server/nav/cost_map.hpp"
#include "server/nav/planner.hpp"

namespace seeker::nav {

/// A border between reachable free floor and the unknown.
struct Frontier {
  Point2 p_map = Point2::Zero();  ///< its cheapest cell
  double cost = 0.0;              ///< to get there
  /// Of all of it. A border ends at obstacles, from which the robot's centre keeps its radius: of a door of 0.8 m it
  /// can reach 0.2 m, and yet the door is as wide as it is.
  double length_m = 0.0;
  std::vector<CellIndex> cells;  ///< what the robot's centre can reach of it, of the cost map
};

/// Every frontier of at least `min_length_m` of which the robot's centre can reach something, cheapest first.
[[nodiscard]] std::vector<Frontier> find_frontiers(const CostMap& map, const DistanceField& costs, double min_length_m);

/// True when p lies within `radius_m` of one of the places.
[[nodiscard]] bool near_any(const Point2& p_map, const std::vector<Point2>& places, double radius_m);

}  // namespace seeker::nav
