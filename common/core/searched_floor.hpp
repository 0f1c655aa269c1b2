/// \file
/// What a robot has searched, as others are told.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/pose2.hpp"

namespace seeker {

inline constexpr double kMaxSearchedCell_m = 1.0;  ///< a cell of searched floor is not larger

/// Proof that targets would have been seen, by the looks of one robot.
struct SearchedFloor {
  std::vector<std::string> targets;  ///< names of all that the looks were for
  Pose2 map_T_grid;  ///< of the frame that the grid lies in: moving the floor leaves the cells as they are
  /// That each of the targets would have been seen if it stood in a cell, times 254. Never null where it is told; it is
  /// shared, since floors of buildings are large and go through many hands.
  std::shared_ptr<const Grid<std::uint8_t>> probability;

  /// By what the grids say, not by where they lie in memory.
  friend bool operator==(const SearchedFloor& a, const SearchedFloor& b) {
    const bool same_cells =
        a.probability == b.probability || (a.probability && b.probability && *a.probability == *b.probability);
    return same_cells && a.targets == b.targets && a.map_T_grid == b.map_T_grid;
  }
};

/// Of several robots; null: nothing is told.
using SharedSearch = std::shared_ptr<const std::vector<SearchedFloor>>;

}  // namespace seeker
