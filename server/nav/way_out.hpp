/// \file
/// Where a way begins that the robot may have to leave tight space for first.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "server/nav/cost_map.hpp"

namespace seeker::nav {

/// Traversable cells connected to `start` (over sides: the same as eight directions without cutting corners), nearest
/// first; the search ends when `enough` are found.
[[nodiscard]] std::vector<CellIndex> connected_cells(const CostMap& map, CellIndex start,
                                                     std::size_t enough = std::numeric_limits<std::size_t>::max());

/// The cell from which a robot at `p_map` sets out: the nearest traversable one within `radius_m`, as of
/// CostMap::nearest_traversable, of floor that leads somewhere. Among chair legs that is often not the nearest cell at
/// all, which lies on a bit of floor no larger than the robot. Larger floor is gone to over free cells only, nowhere
/// nearer to anything than the robot's body is wide; where none is in reach, the nearest cell is all there is.
[[nodiscard]] std::optional<CellIndex> way_out(const CostMap& map, const Point2& p_map, double radius_m);

}  // namespace seeker::nav
