/// \file
/// Ways that somebody stands in: what would be left to explore if whoever is there went on.
#pragma once

#include <vector>

#include "server/explore/openings.hpp"
#include "server/nav/known_floor.hpp"

namespace seeker::explore {

struct BlockedWays {
  std::vector<Point2> at_map;      ///< where somebody stands in a way, frame `map`
  std::vector<Point2> behind_map;  ///< what the ways would lead to: borders of the unknown, floor that is cut off
};

/// Who stands on known floor is in the way only of what no way leads to now, and one would if he went on: people in a
/// room that is mapped are not waited for. `obstacles_map` are those that the map does not show; they are taken for
/// people too, since what met the robot on its way and has left is remembered for a while.
[[nodiscard]] BlockedWays blocked_ways(const OpeningsInput& input, const nav::KnownFloor& known,
                                       const std::vector<Point2>& obstacles_map, const ViewpointParams& params);

}  // namespace seeker::explore
