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
  double length_m = 0.0;
  std::vector<CellIndex> cells;  ///< all of it, of the cost map
};

/// Every frontier of at least `min_length_m`, cheapest first. Only cells that the robot's centre can reach.
[[nodiscard]] std::vector<Frontier> find_frontiers(const CostMap& map, const DistanceField& costs, double min_length_m);

/// True when p lies within `radius_m` of one of the places.
[[nodiscard]] bool near_any(const Point2& p_map, const std::vector<Point2>& places, double radius_m);

}  // namespace seeker::nav
