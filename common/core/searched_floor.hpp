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

/// Proof that targets would have been seen, by the looks of one robot.
struct SearchedFloor {
  std::vector<std::string> targets;  ///< names of all that the looks were for
  Pose2 map_T_grid;  ///< of the frame that the grid lies in: moving the floor leaves the cells as they are
  Grid<std::uint8_t> probability;  ///< that each of the targets would have been seen if it stood in a cell, times 254

  friend bool operator==(const SearchedFloor&, const SearchedFloor&) = default;
};

/// Of several robots; null: nothing is told.
using SharedSearch = std::shared_ptr<const std::vector<SearchedFloor>>;

}  // namespace seeker
