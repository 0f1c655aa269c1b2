/// \file
/// Choice of the place where the robot waits for a blocked place to become free: in sight of it, or aside.
#pragma once

#include <optional>

#include "server/nav/floor_view.hpp"
#include "server/nav/planner.hpp"

namespace seeker::nav {

/// The place with the shortest path from which the robot sees what stands at `place_map`; places near it are preferred
/// to places a little farther off. Where no place sees it, the nearest one is returned. Nothing: no path leads near.
/// `costs` is computed on floor.cost, from the robot.
[[nodiscard]] std::optional<Point2> lookout_for(const Point2& place_map, const FloorView& floor,
                                                const DistanceField& costs);

/// The nearest place with enough room around it for a person at `place_map` to walk by; where there is little room
/// anywhere near, the place with the most. Nothing: no path leads away.
[[nodiscard]] std::optional<Point2> place_aside(const Point2& place_map, const FloorView& floor,
                                                const DistanceField& costs);

}  // namespace seeker::nav
