/// \file
/// Numbers of everything that chooses among places: what is left to explore, the horizon planner, two baselines.
#pragma once

namespace seeker::explore {

struct ViewpointParams {
  // What is left to explore.
  double min_frontier_m = 0.4;   ///< shorter borders, obstacle to obstacle, are noise: no robot fits through
  double max_frontier_m = 3.0;   ///< longer ones are cut into pieces
  double min_pocket_m2 = 0.1;    ///< unknown floor smaller than this is noise
  double min_face_m = 0.5;       ///< shorter sides of walls that nobody has seen are noise
  double min_extension_m = 0.3;  ///< ends of walls that can grow by less are left as they are
  double max_extension_m = 2.0;  ///< farther beyond its end a wall is not followed in thought
  double view_range_m = 3.0;     ///< an end so near, not seen too flat, has been looked at well
  double reached_m = 0.5;        ///< a border so near to the robot has been looked at
  double same_m = 0.5;           ///< openings of one kind so near to each other are the same one
  int max_visits = 2;            ///< of one opening without change: then it is settled
  double look_s = 1.0;           ///< how long one look takes
  int max_failures = 3;          ///< drives that failed: then no way leads there
  double retry_s = 20.0;         ///< after a failed drive others are tried first for so long
  int max_waits = 6;             ///< of retry_s, at one place where somebody stands in the way: two minutes
  double failed_radius_m = 0.4;  ///< openings so near to a place that could not be reached rest with it
  double min_cut_off_m2 = 1.0;   ///< free floor seen but not connected to the robot's, if larger, is unreachable
  double replan_period_s = 2.0;  ///< goals are looked at again this often while driving

  // Gain.
  double gain_lambda_1_m = 0.15;  ///< what is a metre of way farther counts exp(-this) as much
  double min_gain_m2 = 0.3;       ///< less unknown floor in sight is not worth a drive of the gain baseline

  // Horizon.
  int horizon = 3;             ///< drives that the planner thinks ahead
  int beam = 6;                ///< sequences it keeps
  double hysteresis_lg = 0.1;  ///< while driving, another goal must be better by so much, in lg of the objective
  int max_candidates = 32;     ///< openings it considers
  double weight_floor = 1.0;   ///< of lg(unknown floor in sight)
  double weight_path = 2.0;    ///< a gain counts by the way until it is got to the power of minus this
};

}  // namespace seeker::explore
