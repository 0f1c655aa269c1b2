/// \file
/// Where to wait for a place to become free again: where one sees it, or out of the way.
#pragma once

#include <optional>

#include "server/nav/floor_view.hpp"
#include "server/nav/planner.hpp"

namespace seeker::nav {

/// The place with the shortest way that sees what stands at `place_map`, near it first, then a little farther off;
/// where nothing sees it, the nearest. Nothing where no way leads near. `costs` is of floor.cost, from the robot.
[[nodiscard]] std::optional<Point2> lookout_for(const Point2& place_map, const FloorView& floor,
                                                const DistanceField& costs);

/// The nearest place with room around it, so that whoever stands at `place_map` can walk by; where there is little room
/// anywhere near, the place with the most. Nothing where no way leads off.
[[nodiscard]] std::optional<Point2> place_aside(const Point2& place_map, const FloorView& floor,
                                                const DistanceField& costs);

}  // namespace seeker::nav
