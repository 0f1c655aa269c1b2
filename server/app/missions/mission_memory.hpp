/// \file
/// What missions go on from when their program was cut off.
#pragma once

#include <cstdint>
#include <optional>

#include "common/api/perception.hpp"
#include "common/core/grid.hpp"
#include "common/core/topology.hpp"

namespace seeker::app {

/// What a search has done so far, frame `map`.
struct SearchMemory {
  /// Probability that each target would have been seen if it stood in a cell, times 254 (see SearchedFloor).
  Grid<std::uint8_t> looks;
  api::GridLists lists;

  friend bool operator==(const SearchMemory&, const SearchMemory&) = default;
};

/// What a mission knows besides its map and its place, in the map of the same moment.
struct MissionMemory {
  std::optional<TopologyMemory> topology;  ///< of an exploration by topology
  std::optional<SearchMemory> search;      ///< of a search

  friend bool operator==(const MissionMemory&, const MissionMemory&) = default;
};

}  // namespace seeker::app
