/// \file
/// Numbers of everything that chooses among places: what is left to explore, the horizon planner, two baselines.
#pragma once

namespace seeker::explore {

struct ViewpointParams {
  double min_frontier_m = 0.4;   ///< shorter borders are noise
  double reached_m = 0.5;        ///< a place so near to the robot has been looked at
  int max_visits = 2;            ///< of one opening without change: then it is settled
  double failed_radius_m = 0.4;  ///< openings so near to a place that could not be reached are not tried
  int horizon = 3;               ///< drives that the planner thinks ahead
  int beam = 6;                  ///< sequences it keeps
  double replan_period_s = 2.0;  ///< goals are looked at again this often while driving
  double weight_path = 1.0;      ///< of lg(path) in the score
};

}  // namespace seeker::explore
