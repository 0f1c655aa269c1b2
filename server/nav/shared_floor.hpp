/// \file
/// Occupancy of several robots in one frame, so that robots can use what others have observed. Cells as in
/// OccupancyTile.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/pose2.hpp"

namespace seeker::nav {

/// The same floor in another frame: every new cell takes the value of the old cell that contains its centre. Cells of
/// different results line up.
[[nodiscard]] Grid<std::uint8_t> carried(const Grid<std::uint8_t>& floor, const Pose2& new_T_old);

/// `own`, with the cells of `other` where `own` is unknown; the result covers both. Both must have the resolution of
/// tiles and cells that line up, as snapshots and carried() have.
[[nodiscard]] Grid<std::uint8_t> with_known(const Grid<std::uint8_t>& own, const Grid<std::uint8_t>& other);

/// Occupancy that several holders share without copying.
using SharedFloor = std::shared_ptr<const Grid<std::uint8_t>>;
/// Several floors in the one frame that their poses lead to. Of cells that several floors know, the value of the first
/// counts. Null for an empty list.
[[nodiscard]] SharedFloor carried(const std::vector<std::pair<Pose2, SharedFloor>>& floors);

}  // namespace seeker::nav
