/// \file
/// Walls as lines that no ray passes: what is mapped of them, and as far as that lets more of them be expected.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/line_map.hpp"
#include "common/core/mapped_side.hpp"
#include "server/nav/cost_map.hpp"

namespace seeker::explore {

/// Cells, on the grid of `map`, of the mapped walls and of those that are expected: 1 where there is one. A wall is
/// expected to go on beyond its virtual end, straight through unknown floor, for `longest_m`, so that the floor behind
/// a hidden corner of a room ends at the room's walls. Shorter than a door is wide, such a wall hides no room.
/// `others_sides`: walls that other robots have mapped; of their ends it is not known whether they are virtual, and
/// beyond one that is not there is free floor.
[[nodiscard]] Grid<std::uint8_t> expected_walls(const nav::CostMap& map, const std::vector<MapSegment>& segments,
                                                double longest_m, std::span<const MappedSide> others_sides = {});

}  // namespace seeker::explore
