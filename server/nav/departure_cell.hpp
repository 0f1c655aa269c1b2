/// \file
/// Choice of the cell where a path starts when the robot stands in tight space.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "server/nav/cost_map.hpp"

namespace seeker::nav {

/// Traversable cells connected to `start`, nearest first; the search ends when `enough` are found. Cells are connected
/// over sides, which is the same as eight directions without cutting corners.
[[nodiscard]] std::vector<CellIndex> connected_cells(const CostMap& map, CellIndex start,
                                                     std::size_t enough = std::numeric_limits<std::size_t>::max());

/// The cell from which a path of a robot at `p_map` starts: the nearest traversable one within `radius_m`, as of
/// CostMap::nearest_traversable, that belongs to floor larger than the robot. Among chair legs the nearest cell often
/// lies on a piece of floor no larger than the robot. The robot reaches the larger floor over free cells only, nowhere
/// nearer to an obstacle than its body is wide; where no such floor is in reach, the result is the nearest cell.
[[nodiscard]] std::optional<CellIndex> departure_cell(const CostMap& map, const Point2& p_map, double radius_m);

}  // namespace seeker::nav
