/// \file
/// Parts of a grid, their cells connected over sides.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "common/core/grid.hpp"

namespace seeker::nav {

/// The cells connected to `start`, nearest first; the search ends when `enough` are found. `enter` is called with the
/// neighbours of every cell: it returns whether one belongs to the part and was not entered before, and records that.
/// The caller has entered `start` itself.
template <class Enter>
std::vector<CellIndex> flood(CellIndex start, const Enter& enter,
                             std::size_t enough = std::numeric_limits<std::size_t>::max()) {
  std::vector<CellIndex> cells{start};
  for (std::size_t k = 0; k < cells.size() && cells.size() < enough; ++k) {
    const CellIndex c = cells[k];
    for (const CellIndex next :
         {CellIndex{c.i + 1, c.j}, CellIndex{c.i - 1, c.j}, CellIndex{c.i, c.j + 1}, CellIndex{c.i, c.j - 1}}) {
      if (enter(next)) {
        cells.push_back(next);
      }
    }
  }
  return cells;
}

}  // namespace seeker::nav
