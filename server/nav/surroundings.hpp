/// \file
/// How much of what lies around the robot its sensors have not shown yet.
#pragma once

#include "server/nav/occupancy_map.hpp"

namespace seeker::nav {

/// Share of the directions from `p_map`, 0 to 1, in which nothing is known between `from_m` and `to_m`. What the
/// robot's own body covers counts with `from_m`: many sensors never see it.
[[nodiscard]] double unseen_share(const OccupancyMap& map, const Point2& p_map, double from_m, double to_m);

}  // namespace seeker::nav
