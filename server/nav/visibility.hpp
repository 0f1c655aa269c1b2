/// \file
/// What can be seen from where, over an occupancy grid (cells as in OccupancyTile).
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/grid.hpp"

namespace seeker::nav {

struct VisibilityParams {
  double occupied_probability = 0.6;  ///< at or above: hides what is behind
  bool unknown_blocks = true;         ///< evidence must not pass through what nobody has seen
};

/// True when no cell strictly between the cells of a and b hides b (a and b themselves may be occupied: one can see a
/// wall). False when either lies outside the grid.
[[nodiscard]] bool line_of_sight(const Grid<std::uint8_t>& occupancy, const Point2& a_map, const Point2& b_map,
                                 const VisibilityParams& params = {});

/// Cells of `occupancy` that a fan of rays from `from_map` up to `range_m` passes, each once, the hiding cell of every
/// ray included. Empty when `from_map` lies outside.
[[nodiscard]] std::vector<CellIndex> visible_cells(const Grid<std::uint8_t>& occupancy, const Point2& from_map,
                                                   double range_m, const VisibilityParams& params = {});

/// Cells of a coarser grid (`wanted` != 0, e.g. the reachable floor at 0.2 m) whose centre is within `range_m` and in
/// line of sight: what one look from `from_map` adds to the evidence of a search.
[[nodiscard]] std::vector<CellIndex> visible_cells_of(const Grid<std::uint8_t>& wanted,
                                                      const Grid<std::uint8_t>& occupancy, const Point2& from_map,
                                                      double range_m, const VisibilityParams& params = {});

}  // namespace seeker::nav
