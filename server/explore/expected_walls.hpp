/// \file
/// Walls as lines that no ray passes: what is mapped of them, and as far as that lets more of them be expected.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/line_map.hpp"
#include "server/nav/cost_map.hpp"

namespace seeker::explore {

/// Cells, on the grid of `map`, of the mapped walls and of those that are expected: 1 where there is one. A wall is
/// expected to go on beyond its virtual end, straight through unknown floor, for `longest_m`, so that the floor behind
/// a hidden corner of a room ends at the room's walls. Shorter than a door is wide, such a wall hides no room.
[[nodiscard]] Grid<std::uint8_t> expected_walls(const nav::CostMap& map, const std::vector<MapSegment>& segments,
                                                double longest_m);

}  // namespace seeker::explore
