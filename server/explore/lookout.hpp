/// \file
/// From where to see whether a place has become free again.
#pragma once

#include <optional>

#include "server/nav/floor_view.hpp"
#include "server/nav/planner.hpp"

namespace seeker::explore {

/// The place with the shortest way that sees what stands at `place_map`, near it first, then a little farther off;
/// where nothing sees it, the nearest. Nothing where no way leads near. `costs` is of floor.cost, from the robot.
[[nodiscard]] std::optional<Point2> lookout_for(const Point2& place_map, const nav::FloorView& floor,
                                                const nav::DistanceField& costs);

}  // namespace seeker::explore
