/// \file
/// Every number of a search that one may tune.
#pragma once

#include "common/core/result.hpp"
#include "server/nav/cost_map.hpp"
#include "server/nav/planned_driver.hpp"
#include "server/nav/wait_turns.hpp"
#include "server/search/detection_params.hpp"
#include "server/search/drive_law.hpp"
#include "server/search/evidence.hpp"
#include "server/search/hit_rate.hpp"

namespace seeker::search {

/// Coverage as printed (spec S3.3).
struct PaperParams {
  double cell_m = 0.8;            ///< d: side of a cell
  double sonar_limit_m = 1.6;     ///< D: a side reading beyond it makes a potential cell
  double robot_radius_m = 0.26;   ///< r
  int passes_limit = 10;          ///< N; 0: from eq (1) with area_m2
  double area_m2 = 25.0;          ///< S of eq (1)
  double reach_time_s = 60.0;     ///< an unsearched cell not reached by then is unreachable
  double progress_time_s = 10.0;  ///< nor one without progress for so long
  double progress_m = 0.10;       ///< what counts as progress
  double stuck_time_s = 8.0;      ///< local planner got nowhere (less than stuck_move_m): recovery
  double stuck_move_m = 0.25;     ///< ...
  double recovery_back_m = 0.15;  ///< a recovery backs out so far before it turns; 0: it only turns
  double recovery_turn_s = 6.0;   ///< longest turn of one recovery
  double recovery_omega_rad_s = 0.5;
  double recovery_clear_m = 1.0;  ///< front distance that ends a recovery
  int max_recoveries = 4;         ///< in a row, before the cell (or the mission) is given up
  double sonar_silence_s = 0.5;   ///< older readings stop the robot
  DriveLawParams drive;
};

/// Coverage over the map (strategies plan, spiral, frontier).
struct PlanParams {
  double cell_m = 0.8;
  double replan_period_s = 2.0;           ///< cost map and goals are refreshed this often while driving
  double map_period_s = 1.0;              ///< shortest time between two cost maps
  double look_spacing_m = 0.8;            ///< travelled distance after which a picture is taken on the way
  bool look_while_moving = true;          ///< false: stop for the pictures on the way, too
  double cell_target_probability = 0.55;  ///< evidence a cell should reach, above the certificate's threshold
  double min_gain_cells = 6.0;            ///< expected new evidence (cells x probability) that is worth a drive
  double frontier_bonus_cells = 12.0;     ///< worth of an unknown border in the same unit
  double travel_offset_m = 1.0;           ///< gain / (cost + offset): keeps near crumbs from winning
  double min_frontier_m = 0.4;            ///< shorter borders, obstacle to obstacle, are noise
  double frontier_reach_m = 0.5;          ///< a goal so near to a frontier observes it
  int max_failures = 2;                   ///< failed drives to a goal before it is unreachable
  double goal_time_s = 120.0;             ///< nor may a drive go on for so long without getting nearer to it
  double failed_radius_m = 0.4;           ///< goals so near to an unreachable place are not tried
  double retry_s = 20.0;                  ///< so long others go before a goal that was not reached, or a wait lasts
  double min_cut_off_m2 = 1.0;            ///< unsearched floor that a way led to before, if larger, is waited for
  double min_look_spacing_m = 0.3;        ///< a look from nearer than this to an earlier one teaches nothing
  nav::WaitParams waits;
  nav::CostMapParams cost;
  nav::FollowerParams follower;

  [[nodiscard]] nav::DriverParams driver() const { return {.goal_time_s = goal_time_s, .follower = follower}; }
};

/// Looking, confirming, approaching.
struct MissionParams {
  double image_timeout_s = 5.0;  ///< a picture that does not come: go on without it
  double settle_s = 0.3;         ///< standing before a still picture
  double standoff_m = 0.8;       ///< approach ends so far in front of the target
  double standoff_tolerance_m = 0.25;
  double face_tolerance_rad = 0.1;
  double approach_time_s = 90.0;      ///< then the position is what it is
  double confirm_time_s = 45.0;       ///< then an unconfirmed track is refused and the search goes on
  double confirm_step_m = 0.7;        ///< way to the second place
  int confirm_looks = 3;              ///< without another sighting: refused
  double max_position_sigma_m = 3.0;  ///< beyond it the search ends as uncertain
};

struct SearchParams {
  PaperParams paper;
  PlanParams plan;
  MissionParams mission;
  EvidenceParams evidence;
  HitRate hit_rate;
  DetectionParams detection;
};

/// Refuses values that make no sense (non-positive sizes and times, probabilities outside 0..1).
[[nodiscard]] Status validate(const SearchParams& params);

}  // namespace seeker::search
