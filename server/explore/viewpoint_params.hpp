/// \file
/// Parameters of all rules that choose among places: openings, the horizon planner, and two baselines.
#pragma once

namespace seeker::explore {

struct ViewpointParams {
  // What is left to explore.
  double min_frontier_m = 0.4;   ///< shorter frontiers, from obstacle to obstacle, are noise: no robot fits through
  double max_frontier_m = 3.0;   ///< longer frontiers are cut into pieces of at most this length
  double min_pocket_m2 = 0.1;    ///< unknown floor smaller than this is noise
  double min_face_m = 0.5;       ///< shorter unobserved sides of walls are noise
  double min_extension_m = 0.3;  ///< ends of walls that can grow by less are ignored
  double max_extension_m = 2.0;  ///< largest expected extension of a wall beyond its end
  double view_range_m = 3.0;     ///< an end within this distance, not seen at too flat an angle, has been observed well
  double reached_m = 0.5;        ///< a frontier within this distance of the robot has been observed
  double same_m = 0.5;           ///< openings of one kind within this distance of each other are the same one
  int max_visits = 2;            ///< number of observations of one opening without change after which it is settled
  double look_s = 1.0;           ///< duration of one observation
  int max_failures = 3;          ///< number of failed drives after which no path is assumed to lead there
  double retry_s = 20.0;         ///< time after a failed drive during which other openings are tried first
  int max_waits = 6;  ///< number of waits of retry_s at one place where somebody blocks the path: two minutes
  /// Openings within this distance of a place that could not be reached rest together with it.
  double failed_radius_m = 0.4;
  /// Observed free floor that is not connected to the robot and is larger than this is unreachable.
  double min_cut_off_m2 = 1.0;
  double replan_period_s = 2.0;  ///< period at which goals are reconsidered while driving

  // Gain.
  double gain_lambda_1_m = 0.15;  ///< a place whose path is one metre longer counts exp(-this) as much
  double min_gain_m2 = 0.3;  ///< the gain baseline drives only to places with more unknown floor in sight than this

  // Horizon.
  int horizon = 3;             ///< number of drives that the planner looks ahead
  int beam = 6;                ///< number of sequences it keeps
  double hysteresis_lg = 0.1;  ///< while driving, another goal must be better by this much, in lg of the objective
  int max_candidates = 32;     ///< number of openings it considers
  double weight_floor = 1.0;   ///< weight of lg(unknown floor in sight)
  double weight_path = 2.0;  ///< a gain counts with the path length at which it is obtained to the power of minus this
};

}  // namespace seeker::explore
