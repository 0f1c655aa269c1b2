/// \file
/// All tunable parameters of an exploration.
#pragma once

#include "common/core/result.hpp"
#include "server/explore/one_step_params.hpp"
#include "server/explore/tour_params.hpp"
#include "server/explore/viewpoint_params.hpp"
#include "server/nav/cost_map.hpp"
#include "server/nav/planned_driver.hpp"

namespace seeker::explore {

/// Limits that end an exploration or send the robot back to a place where its pose was certain.
struct GuardParams {
  /// Standard deviation of the position beyond which the robot returns to where it was certain. The limit is as large
  /// as a metre because the estimator allows for uneven floors and tilted scanners: on a floor of 1100 m2 it reports
  /// 0.35 m on average where the true error is 0.04 m.
  double max_position_sigma_m = 1.0;
  double regain_position_sigma_m = 0.5;  ///< the robot explores on below this standard deviation
  /// The exploration ends as uncertain when no place of the return path was reached for this time, or when the position
  /// is still uncertain for this time after the last place.
  double regain_time_s = 180.0;
  double battery_reserve_v = 11.5;  ///< the exploration ends below this voltage; Pioneer 3-DX: 12 V lead accumulators
  double home_m_s = 0.3;            ///< average speed of the return to the start, including stops and rotations
  double home_margin = 1.5;  ///< the return starts when the remaining time is its expected duration times this factor
  double home_reserve_s = 20.0;  ///< plus this time, for braking, turning around, and driving until the next check
};

struct ExploreParams {
  OneStepParams one_step;
  WallParams wall;
  RoamParams roam;
  ViewpointParams viewpoints;
  TourParams tour;
  GuardParams guard;
  nav::CostMapParams cost;
  nav::DriverParams driver;
  double floor_cell_m = 0.2;
  double map_period_s = 1.0;       ///< shortest time between two cost maps
  double segments_period_s = 0.5;  ///< shortest time between two readings of all segments of the map
};

/// Refuses values that are invalid or contradict each other.
[[nodiscard]] Status validate(const ExploreParams& params);

}  // namespace seeker::explore
