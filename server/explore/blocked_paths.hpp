/// \file
/// Paths that a person or an object blocks, and what could be explored if the blocked places became free.
#pragma once

#include <vector>

#include "server/explore/openings.hpp"
#include "server/nav/known_floor.hpp"

namespace seeker::explore {

struct BlockedPaths {
  std::vector<Point2> at_map;                ///< places where somebody blocks a path, frame `map`
  std::vector<UnreachablePlace> behind_map;  ///< goals of the blocked paths: frontiers, and floor that is cut off
};

/// Finds who blocks a path. A person or object on known floor is reported only when a goal has no path now and would
/// have one without them, so that the robot does not wait for people in a room that is mapped. `obstacles_map` are
/// obstacles that the map does not show; they count as people too, because an obstacle that the robot met and that has
/// left is remembered for a while.
[[nodiscard]] BlockedPaths blocked_paths(const OpeningsInput& input, const nav::KnownFloor& known,
                                         const std::vector<Point2>& obstacles_map, const ViewpointParams& params);

}  // namespace seeker::explore
