/// \file
/// Area of unknown floor that a place would show: the gain of a next best view.
#pragma once

#include <cstdint>

#include "common/core/grid.hpp"
#include "server/explore/one_step_params.hpp"
#include "server/nav/cost_map.hpp"

namespace seeker::explore {

struct ViewGain {
  double area_m2 = 0.0;      ///< area of unknown floor in sight
  double heading_rad = 0.0;  ///< heading of the base that shows most of it, frame `map`
};

/// Casts rays over the occupancy, each ended by an obstacle or by the sensor's range. Behind a few metres of unknown
/// floor a wall is expected, so that no further area counts; nor does what lies behind `walls`, cells on the grid of
/// `map` (expected_walls.hpp). The sensor observes within its half angle around the heading, and the best heading is
/// searched.
[[nodiscard]] ViewGain view_gain(const nav::CostMap& map, const Point2& from_map, const SensorModel& sensor,
                                 const Grid<std::uint8_t>* walls = nullptr);

}  // namespace seeker::explore
