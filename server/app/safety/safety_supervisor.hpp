/// \file
/// The last word on motion (design section 7): clamps or refuses what mission and operator want. Pure.
#pragma once

#include <string>
#include <vector>

#include "common/api/robot_state.hpp"
#include "common/core/scan.hpp"
#include "server/app/safety/lease.hpp"
#include "server/nav/clearance.hpp"
#include "server/nav/movers.hpp"

namespace seeker::app {

struct SafetyParams {
  double max_v_m_s = 0.75;
  double max_omega_rad_s = 1.2;
  nav::ClearanceParams clearance;
  double sonar_stop_range_m = 0.8;  ///< echoes beyond it never limit motion: the cones are too wide
  double sonar_slack_m = 0.25;      ///< an echo this much nearer than the lidar sees is a low obstacle of its own
  LeaseParams lease;
};

struct SafetyInput {
  Twist2 wanted = {};
  bool may_be_cut = false;  ///< a client's command, which ends at any moment when the link breaks
  bool armed = false;
  bool estop = false;
  const api::Fault* blocking = nullptr;  ///< a fault that forbids motion
  const LaserScan* scan = nullptr;
  const SonarScan* sonar = nullptr;
  Pose2 base_T_scan = {};   ///< where the base was when the scan was taken, in `base` now: readings age
  Pose2 base_T_sonar = {};  ///< and the echoes
  Twist2 velocity = {};     ///< of the robot now
  std::vector<nav::Mover> movers_base = {};  ///< other robots, frame `base`
  std::vector<Point2> remembered_base = {};  ///< obstacles where no sensor looks now, frame `base`; see RecentObstacles
};

struct SafetyVerdict {
  Twist2 allowed;
  std::string reason;  ///< why less than wanted is allowed; empty when all is
};

/// Obstacles around the base now: lidar returns, echoes that the lidar cannot explain, and what is remembered.
[[nodiscard]] std::vector<Point2> obstacle_points(const SafetyInput& input, const SafetyParams& params);

[[nodiscard]] SafetyVerdict supervise(const SafetyInput& input, const SafetyParams& params);

}  // namespace seeker::app
