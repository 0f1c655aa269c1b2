/// \file
/// Viewpoints that together see a building: a greedy cover of its floor and of the outlines of its walls.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/result.hpp"

namespace seeker::tour {

/// A building as somebody knows it who has its plan. The three grids have one frame.
struct KnownBuilding {
  Grid<std::uint8_t> blocks;  ///< 1: hides what is behind it, and is to be seen: a wall, furniture
  Grid<std::uint8_t> free;    ///< 1: floor that is to be seen; what is neither hides too, and nobody wants to see it
  Grid<std::uint8_t> drive;   ///< 1: the robot's centre can be there and a path leads there from the start
};

struct CoverageParams {
  double range_m = 8.0;  ///< how far the sensor sees; it looks in all directions
  double share = 0.985;  ///< share of the floor and of the walls, of what any viewpoint sees, that must be seen
  double step_m = 0.5;   ///< distance of the viewpoints that are tried
};

struct Coverage {
  std::vector<Point2> views;  ///< in the order of what they add
  double floor_m2 = 0.0;      ///< floor that any viewpoint sees
  double wall_m = 0.0;        ///< outline of walls and furniture that any viewpoint sees, in cells of 0.1 m
  double floor_share = 0.0;   ///< share of it that the chosen viewpoints see
  double wall_share = 0.0;
};

/// Chooses viewpoints greedily until both shares are reached. What the sensor sees from `already`, such as the start,
/// needs no viewpoint. kInvalidArgument: a parameter makes no sense, or the grids do not fit each other. kUnreachable:
/// there is no floor to drive on. kTooLarge: more viewpoints to try than memory holds; a larger step makes them fewer.
[[nodiscard]] Result<Coverage> cover(const KnownBuilding& building, const std::vector<Point2>& already,
                                     const CoverageParams& params = {});

}  // namespace seeker::tour
