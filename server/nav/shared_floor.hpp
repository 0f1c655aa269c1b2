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

/// Walls of two maps within this distance of each other may be the same.
inline constexpr double kSameWall_m = 0.1;

/// `own`, with the cells of `other` where `own` is unknown or undecided; the result covers both. Where free floor of
/// the one ends within kSameWall_m of what the other saw occupied, it ends at that: two maps lie a cell or two beside
/// each other, and a wall that was mapped would else leave a border of unknown floor. Both must have the resolution of
/// tiles and cells that line up, as snapshots and carried() have.
[[nodiscard]] Grid<std::uint8_t> with_known(const Grid<std::uint8_t>& own, const Grid<std::uint8_t>& other);

/// Occupancy that several holders share without copying.
using SharedFloor = std::shared_ptr<const Grid<std::uint8_t>>;
/// Several floors in the one frame that their poses lead to. Of cells that several floors know, the value of the first
/// counts. Null for an empty list.
[[nodiscard]] SharedFloor carried(const std::vector<std::pair<Pose2, SharedFloor>>& floors);

}  // namespace seeker::nav
