/// \file
/// Visibility between places on an occupancy grid (cells as in OccupancyTile).
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/grid.hpp"

namespace seeker::nav {

struct VisibilityParams {
  double occupied_probability = 0.6;  ///< a cell with at least this occupancy probability hides what is behind it
  /// True: unknown cells hide what is behind them, so that no evidence passes through them.
  bool unknown_blocks = true;
};

/// Whether no cell strictly between the cells of a and b hides b. The cells of a and b themselves may be occupied,
/// because a wall can be seen. False when either lies outside the grid.
[[nodiscard]] bool line_of_sight(const Grid<std::uint8_t>& occupancy, const Point2& a_map, const Point2& b_map,
                                 const VisibilityParams& params = {});

/// Cells of a coarser grid (`wanted` != 0, for example the reachable floor at 0.2 m) whose centre is within `range_m`
/// and in line of sight: the cells that one observation from `from_map` covers in a search.
[[nodiscard]] std::vector<CellIndex> visible_cells_of(const Grid<std::uint8_t>& wanted,
                                                      const Grid<std::uint8_t>& occupancy, const Point2& from_map,
                                                      double range_m, const VisibilityParams& params = {});

}  // namespace seeker::nav
