/// \file
/// The cell of a coarse floor that a place belongs to.
#pragma once

#include <optional>

#include "common/core/grid.hpp"

namespace seeker::tour {

/// The nearest cell that is not 0, at most three cells off along either axis: a place beside the floor belongs to it.
/// Nothing: there is none so near.
template <class T>
[[nodiscard]] std::optional<CellIndex> nearest_cell(const Grid<T>& floor, const Point2& p_map) {
  constexpr int kReach_cells = 3;
  const CellIndex centre = floor.frame().cell_of(p_map);
  std::optional<CellIndex> best;
  int best_distance = 2 * kReach_cells * kReach_cells + 1;
  for (int dj = -kReach_cells; dj <= kReach_cells; ++dj) {
    for (int di = -kReach_cells; di <= kReach_cells; ++di) {
      const CellIndex cell{centre.i + di, centre.j + dj};
      const int distance = di * di + dj * dj;
      if (floor.contains(cell) && floor[cell] != 0 && distance < best_distance) {
        best = cell;
        best_distance = distance;
      }
    }
  }
  return best;
}

}  // namespace seeker::tour
