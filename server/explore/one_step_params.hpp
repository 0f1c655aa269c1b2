/// \file
/// Parameters of the one-step objective (spec S1.11), of wall following (S1.12) and of roaming (S1.13).
#pragma once

#include <vector>

#include "common/core/angle.hpp"
#include "server/slam/odometry_tracker.hpp"

namespace seeker::explore {

/// Nominal sensor model of the predictions.
struct SensorModel {
  double range_m = 6.0;
  double half_angle_rad = deg_to_rad(90.0);
  double grazing_rad = deg_to_rad(5.0);  ///< walls seen at a flatter angle than this are not observed
  double sigma_y_m = 0.01;
  double sigma_theta_rad = 0.01;
  double sigma_end_m = 0.03;
  int nominal_points = 8;  ///< the standard deviations above hold for a line of this many points
  double beam_step_rad = deg_to_rad(0.5);
};

struct OneStepParams {
  std::vector<double> v_m_s{0.0, 0.05, 0.10, 0.15};
  std::vector<double> omega_rad_s{-0.17, -0.085, 0.0, 0.085, 0.17};
  double observation_period_s = 4.0;  ///< time for which a control is held
  /// True: the robot stands while observing, as in the paper; false: it decides while driving.
  bool stop_and_go = true;
  double settle_s = 0.3;  ///< with stop_and_go: time at rest before a decision
  /// Time at rest before the first decision. The pose is nowhere better known than at the start, and the walls observed
  /// from there define the heading of the whole map.
  double first_look_s = 5.0;
  /// The robot rotates once on the spot when its position uncertainty has grown by this: the square root of the growth
  /// of its largest variance since the last rotation. 0: never.
  double look_round_m = 0.0;
  double weight_certainty = 1.0;  ///< omega_1
  double weight_extension = 0.5;  ///< omega_21
  double weight_ends = 0.5;       ///< omega_22
  double log_floor = 1e-3;        ///< the objective uses lg max(J, this)
  double swept_radius_m = 0.30;
  /// Virtual ends within this distance of the crossing of their walls are expected to meet there.
  double corner_gap_m = 0.3;
  int trap_decisions = 3;  ///< number of decisions in a row without any gain that is a local trap
  /// Number of decisions in a row with a predicted gain but without either of the growths below that is also a local
  /// trap.
  int fruitless_decisions = 6;
  double least_growth_m = 0.3;   ///< growth of the length of the walls
  double least_growth_m2 = 0.5;  ///< growth of the area of the floor known to be free
  double closed_radius_m = 0.4;  ///< wall ends within this distance of an end that led nowhere are treated as real
  /// Largest number of segments that a prediction updates, the nearest ones: limits the cost of a decision.
  int max_observed = 32;
  /// True: when no wall leads on, drive to the remaining openings by planned paths; false: as printed.
  bool escape_by_path = true;
  /// Whether the known floor is used too: walls do not extend where the floor was observed to be free, obstacles that
  /// are no walls hide what is behind them, and controls keep to floor that is known to be free. false: as printed,
  /// mapped segments and the present scan only.
  bool use_floor = true;
  /// Whether the denominators of eqs (20) and (21) run over all segments of the map, as printed; false: over those
  /// around the robot, because over a whole building every gain falls below log_floor.
  bool all_segments = false;
  SensorModel sensor;
  slam::OdometryParams odometry;  ///< odometry model of the predictions; only its noise is used
};

struct WallParams {
  double distance_m = 0.6;    ///< d_w
  double switch_m = 0.6;      ///< d_sw
  double adjacency_m = 1.0;   ///< largest gap between the end of a wall and the wall that continues it
  double max_offset_m = 4.0;  ///< walls farther from the robot are not followed
  /// Off its line the robot heads for the point of the line that lies this far ahead. 0: in the line's own direction,
  /// from which no control of the set brings a robot nearer that is parallel to its line but far from it.
  double ahead_m = 1.0;
  double leave_growth_m = 0.5;  ///< growth of the length of all walls at which the robot leaves the wall
  /// A new segment is a reason to leave the wall, too, when the walls have grown by at least this: parts of walls come
  /// and go. 0: every new segment is.
  double new_segment_m = 0.2;
  /// Whether the growth is that of one step, as in spec S1.12, or that since the robot began to follow walls.
  bool growth_per_step = false;
  /// Spec S1.12 without planned paths: where no wall leads to an open end, the robot follows the walls all the same,
  /// counter-clockwise for one lap, and it rounds every end that no wall continues. false: wall following ends there.
  bool whole_lap = false;
  double time_limit_s = 300.0;  ///< time limit of one escape along walls, after which planned paths are used
};

struct RoamParams {
  double v_m_s = 0.15;
  double omega_rad_s = 0.17;
  double clear_m = 0.6;
};

}  // namespace seeker::explore
