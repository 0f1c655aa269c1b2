/// \file
/// The floor that a robot has searched, in the form in which robots of a fleet exchange it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/pose2.hpp"

namespace seeker {

inline constexpr double kMaxSearchedCell_m = 1.0;  ///< largest side of a cell of searched floor

/// Probability that targets would have been detected by the looks of one robot, cell by cell.
struct SearchedFloor {
  std::vector<std::string> targets;  ///< names of all targets that the looks were for
  Pose2 map_T_grid;                  ///< pose of the grid's frame: it changes when the map moves, the cells do not
  /// Probability that each of the targets would have been detected if it stood in a cell, times 254. Never null in a
  /// report. The grid is shared and not copied, since floors of buildings are large.
  std::shared_ptr<const Grid<std::uint8_t>> probability;

  /// Compares the cells of the grids, not their addresses.
  friend bool operator==(const SearchedFloor& a, const SearchedFloor& b) {
    const bool same_cells =
        a.probability == b.probability || (a.probability && b.probability && *a.probability == *b.probability);
    return same_cells && a.targets == b.targets && a.map_T_grid == b.map_T_grid;
  }
};

/// The searched floor of several robots; null: no robot has reported any.
using SharedSearch = std::shared_ptr<const std::vector<SearchedFloor>>;

}  // namespace seeker
