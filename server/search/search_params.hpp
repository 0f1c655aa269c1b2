/// \file
/// All tunable parameters of a search.
#pragma once

#include "common/core/result.hpp"
#include "server/nav/cost_map.hpp"
#include "server/nav/planned_driver.hpp"
#include "server/nav/wait_schedule.hpp"
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
  double progress_time_s = 10.0;  ///< longest time without progress towards it
  double progress_m = 0.10;       ///< smallest decrease of the remaining distance that counts as progress
  double stuck_time_s = 8.0;      ///< time with less than stuck_move_m of motion after which a recovery starts
  double stuck_move_m = 0.25;     ///< see stuck_time_s
  double recovery_back_m = 0.15;  ///< distance that a recovery drives backwards before it rotates; 0: it only rotates
  double recovery_rotation_s = 6.0;  ///< longest rotation of one recovery
  double recovery_omega_rad_s = 0.5;
  double recovery_clear_m = 1.0;  ///< front distance that ends a recovery
  int max_recoveries = 4;         ///< recoveries in a row before the cell (or the mission) is given up
  double sonar_silence_s = 0.5;   ///< readings older than this stop the robot
  DriveLawParams drive;
};

/// Coverage over the map (strategies plan, spiral, frontier).
struct PlanParams {
  double cell_m = 0.8;
  double replan_period_s = 2.0;           ///< cost map and goals are refreshed this often while driving
  double map_period_s = 1.0;              ///< shortest time between two cost maps
  double look_spacing_m = 0.5;            ///< driven distance after which a picture is taken while driving
  double stop_spacing_m = 0.8;            ///< the same of a robot that stops for its pictures
  bool look_while_moving = true;          ///< false: the robot also stops for the pictures between goals
  double cell_target_probability = 0.55;  ///< evidence a cell should reach, above the certificate's threshold
  double min_gain_cells = 6.0;            ///< expected new evidence (cells x probability) that is worth a drive
  double frontier_bonus_cells = 12.0;     ///< value of a frontier in the same unit
  double travel_offset_m = 1.0;   ///< gain / (cost + offset): keeps very near goals with little gain from winning
  double min_frontier_m = 0.4;    ///< shorter frontiers, from obstacle to obstacle, are noise
  double frontier_reach_m = 0.5;  ///< a goal within this distance of a frontier observes it
  int max_failures = 2;           ///< failed drives to a goal before it is unreachable
  double goal_time_s = 120.0;     ///< longest time without progress towards the goal before a drive is given up
  double failed_radius_m = 0.4;   ///< goals within this distance of an unreachable place are not tried
  /// Time during which other goals are preferred to one that was not reached; duration of a wait.
  double retry_s = 20.0;
  /// Unsearched floor that a path led to before and that is larger than this justifies a wait.
  double min_cut_off_m2 = 1.0;
  double min_look_spacing_m = 0.3;  ///< a picture taken nearer than this to an earlier one adds no evidence
  nav::WaitParams waits;
  nav::CostMapParams cost;
  /// Faster than other missions drive: what the clearance and the sensors allow limits the speed.
  nav::FollowerParams follower = {.max_v_m_s = 0.75, .rotate_in_place_rad = 0.8, .clearance = {}};

  [[nodiscard]] nav::DriverParams driver() const { return {.goal_time_s = goal_time_s, .follower = follower}; }
};

/// Parameters of taking pictures, confirming and approaching.
struct MissionParams {
  double image_timeout_s = 5.0;  ///< after this time the mission continues without the picture
  double settle_s = 0.3;         ///< time at rest before a still picture
  double standoff_m = 0.8;       ///< distance in front of the target at which the approach ends
  double standoff_tolerance_m = 0.25;
  double face_tolerance_rad = 0.1;
  double approach_time_s = 90.0;  ///< time limit of the approach, after which the position estimate is final
  /// Time limit of a confirmation, after which the track is refused and the search continues.
  double confirm_time_s = 45.0;
  /// Pictures after a doubtful sighting for which the search goes on before it is looked at from a place of its own.
  int doubtful_looks = 2;
  double confirm_step_m = 0.7;        ///< distance to the second place
  int confirm_looks = 3;              ///< number of pictures without another sighting after which the track is refused
  double max_position_sigma_m = 3.0;  ///< standard deviation of the position beyond which the search ends as uncertain
};

struct SearchParams {
  PaperParams paper;
  PlanParams plan;
  MissionParams mission;
  EvidenceParams evidence;
  HitRate hit_rate;
  DetectionParams detection;
};

/// Refuses invalid values (non-positive sizes and times, probabilities outside 0..1).
[[nodiscard]] Status validate(const SearchParams& params);

}  // namespace seeker::search
