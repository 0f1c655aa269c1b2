/// \file
/// Numbers of the one-step objective (spec S1.11), of wall following (S1.12) and of roaming (S1.13).
#pragma once

#include <vector>

#include "common/core/angle.hpp"
#include "server/slam/odometry_tracker.hpp"

namespace seeker::explore {

/// Nominal sensor of the predictions.
struct SensorModel {
  double range_m = 6.0;
  double half_angle_rad = deg_to_rad(90.0);
  double grazing_rad = deg_to_rad(5.0);  ///< walls seen flatter than this are not seen
  double sigma_y_m = 0.01;
  double sigma_theta_rad = 0.01;
  double sigma_end_m = 0.03;
  int nominal_points = 8;  ///< sigmas above hold for a line of so many points
  double beam_step_rad = deg_to_rad(0.5);
};

struct OneStepParams {
  std::vector<double> v_m_s{0.0, 0.05, 0.10, 0.15};
  std::vector<double> omega_rad_s{-0.17, -0.085, 0.0, 0.085, 0.17};
  double observation_period_s = 4.0;  ///< a control is held so long
  bool stop_and_go = true;            ///< stand while observing, as in the paper; false: decide while driving
  double settle_s = 0.3;              ///< of stop_and_go: standing before the decision
  /// Standing before the first decision: nowhere is the pose known better than at the start, and the walls seen from
  /// there give the whole map its direction.
  double first_look_s = 5.0;
  /// The robot turns round once where its position has become less certain by this: the square root of what its largest
  /// variance has grown by since the last turn. 0: never.
  double look_round_m = 0.0;
  double weight_certainty = 1.0;  ///< omega_1
  double weight_extension = 0.5;  ///< omega_21
  double weight_ends = 0.5;       ///< omega_22
  double log_floor = 1e-3;        ///< lg max(J, this)
  double swept_radius_m = 0.30;
  double corner_gap_m = 0.3;  ///< virtual ends so near to a crossing will meet there
  int trap_decisions = 3;     ///< in a row without anything to gain: a local trap
  /// Also a trap: so many in a row that promised something and brought neither of the growths below.
  int fruitless_decisions = 6;
  double least_growth_m = 0.3;   ///< of the walls
  double least_growth_m2 = 0.5;  ///< of the floor known to be free
  double closed_radius_m = 0.4;  ///< ends of walls so near to one that led nowhere are taken for real
  int max_observed = 32;         ///< segments that a prediction updates, the nearest: bounds the cost of a decision
  bool escape_by_path = true;    ///< when no wall leads on, drive to what is left by planned paths; false: as printed
  /// What is known of the floor counts too: walls do not go on where the floor was seen to be free, and obstacles that
  /// are no walls hide what is behind them. false: as printed, mapped segments only.
  bool use_floor = true;
  SensorModel sensor;
  slam::OdometryParams odometry;  ///< of the predictions; only its noise counts
};

struct WallParams {
  double distance_m = 0.6;  ///< d_w
  double switch_m = 0.6;    ///< d_sw
  double adjacency_m = 1.0;
  double leave_growth_m = 0.5;
  double time_limit_s = 300.0;  ///< one escape; then by path
};

struct RoamParams {
  double v_m_s = 0.15;
  double omega_rad_s = 0.17;
  double clear_m = 0.6;
};

}  // namespace seeker::explore
