/// \file
/// Occupancy of several robots in one frame: what one has not seen, another may have. Cells as in OccupancyTile.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/pose2.hpp"

namespace seeker::nav {

/// The same floor in another frame: every new cell is the old one that its centre lies in. Cells of different results
/// line up.
[[nodiscard]] Grid<std::uint8_t> carried(const Grid<std::uint8_t>& floor, const Pose2& new_T_old);

/// `own`, with what `other` knows where `own` knows nothing; as large as both together. Both must have the resolution
/// of tiles and cells that line up, as snapshots and carried() have.
[[nodiscard]] Grid<std::uint8_t> with_known(const Grid<std::uint8_t>& own, const Grid<std::uint8_t>& other);

/// Several floors in one frame, that which their poses lead to; of cells that more than one knows the first counts.
/// Null for an empty list.
using SharedFloor = std::shared_ptr<const Grid<std::uint8_t>>;
[[nodiscard]] SharedFloor carried(const std::vector<std::pair<Pose2, SharedFloor>>& floors);

}  // namespace seeker::nav
