/// \file
/// Frontiers: borders between known free floor and unknown space.
#pragma once

#include <vector>

#include "server/nav/cost_map.hpp"
#include "server/nav/planner.hpp"

namespace seeker::nav {

/// A frontier: a border between reachable free floor and unknown space.
struct Frontier {
  Point2 p_map = Point2::Zero();  ///< the cell of the frontier with the lowest path cost
  double cost = 0.0;              ///< path cost from the robot to that cell
  /// Length of the whole border, in metres. A border ends at obstacles, from which the robot's centre keeps its radius:
  /// of a door 0.8 m wide the centre can reach 0.2 m, but the border is 0.8 m long.
  double length_m = 0.0;
  std::vector<CellIndex> cells;  ///< cells of the cost map on the border that the robot's centre can reach
};

/// All frontiers of at least `min_length_m` that the robot's centre can reach in at least one cell, in order of rising
/// path cost.
[[nodiscard]] std::vector<Frontier> find_frontiers(const CostMap& map, const DistanceField& costs, double min_length_m);

/// Whether floor that the robot's centre can stand on lies beside unknown space within `radius_m` of p.
[[nodiscard]] bool border_near(const CostMap& map, const Point2& p_map, double radius_m);

/// Whether p lies within `radius_m` of one of the places.
[[nodiscard]] bool near_any(const Point2& p_map, const std::vector<Point2>& places, double radius_m);

}  // namespace seeker::nav
