/// \file
/// How much unknown floor a place would show: the gain of a next best view.
#pragma once

#include "server/explore/one_step_params.hpp"
#include "server/nav/cost_map.hpp"

namespace seeker::explore {

struct ViewGain {
  double area_m2 = 0.0;      ///< of unknown floor in sight
  double heading_rad = 0.0;  ///< of the base that shows most of it, frame `map`
};

/// Rays over the occupancy, ended by obstacles and by the sensor's range; behind a few metres of unknown floor a wall
/// is expected, so that nothing more counts. The sensor looks ahead within its half angle: the best heading is found.
[[nodiscard]] ViewGain view_gain(const nav::CostMap& map, const Point2& from_map, const SensorModel& sensor);

}  // namespace seeker::explore
