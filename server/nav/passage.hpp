/// \file
/// Whether a robot that stands somewhere keeps others from passing.
#pragma once

#include "server/nav/cost_map.hpp"
#include "server/nav/planner.hpp"

namespace seeker::nav {

/// Whether a robot of the size of `map` that stands at `p_map` keeps others of its size from parts of the floor: where
/// they cannot pass beside it, the floor that `costs` leads to falls into several parts of at least `min_m2`. `costs`
/// is computed on `map`.
[[nodiscard]] bool blocks_passage(const CostMap& map, const DistanceField& costs, const Point2& p_map, double min_m2);

}  // namespace seeker::nav
