/// \file
/// Every number of an exploration that one may tune.
#pragma once

#include "common/core/result.hpp"
#include "server/explore/one_step_params.hpp"
#include "server/explore/viewpoint_params.hpp"
#include "server/nav/cost_map.hpp"
#include "server/nav/planned_driver.hpp"

namespace seeker::explore {

/// What ends an exploration, or sends the robot back to a place it knows.
struct GuardParams {
  /// Beyond it the robot goes back to where it was certain. As much as a metre, for the estimator allows for bent
  /// floors and scanners that are not level: on a floor of 1100 m2 it says 0.35 m on average where it is 0.04 m off.
  double max_position_sigma_m = 1.0;
  double regain_position_sigma_m = 0.5;  ///< and explores on below this
  /// On the way back no place reached in so long, or not regained so long after the last: it ends as uncertain.
  double regain_time_s = 180.0;
  double battery_reserve_v = 11.5;  ///< below it the exploration ends; Pioneer 3-DX: 12 V lead accumulators
  double home_m_s = 0.3;            ///< it drives home so fast, turns and stops counted in,
  double home_margin = 1.5;         ///< and sets out with so many times the time that this takes,
  double home_reserve_s = 20.0;     ///< and so much more: to brake, turn round, and for what it drives meanwhile
};

struct ExploreParams {
  OneStepParams one_step;
  WallParams wall;
  RoamParams roam;
  ViewpointParams viewpoints;
  GuardParams guard;
  nav::CostMapParams cost;
  nav::DriverParams driver;
  double floor_cell_m = 0.2;
  double map_period_s = 1.0;       ///< shortest time between two cost maps
  double segments_period_s = 0.5;  ///< shortest time between two looks at the whole map of segments
};

/// Refuses values that make no sense.
[[nodiscard]] Status validate(const ExploreParams& params);

}  // namespace seeker::explore
