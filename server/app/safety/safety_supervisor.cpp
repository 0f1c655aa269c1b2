#include "server/app/safety/safety_supervisor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/angle.hpp"

namespace seeker::app {
namespace {

/// Smallest distance from the transducer to a lidar return inside its cone; infinity without one.
double lidar_range_in_cone(const Pose2& base_T_sonar, double half_angle_rad, const std::vector<Point2>& points_base) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Point2& p : points_base) {
    if (std::abs(bearing_to(base_T_sonar, p)) <= half_angle_rad) {
      nearest = std::min(nearest, (p - base_T_sonar.translation()).norm());
    }
  }
  return nearest;
}

}  // namespace

std::vector<Point2> obstacle_points(const SafetyInput& input, const SafetyParams& params) {
  std::vector<Point2> points = input.scan != nullptr ? points_in_base(*input.scan) : std::vector<Point2>();
  std::transform(points.begin(), points.end(), points.begin(),
                 [&](const Point2& p_then) { return input.base_T_scan * p_then; });
  const std::vector<Point2> seen_by_lidar = points;
  points.insert(points.end(), input.remembered_base.begin(), input.remembered_base.end());
  if (input.sonar == nullptr) {
    return points;
  }
  for (const SonarReading& reading : input.sonar->readings) {
    const Pose2 base_T_transducer = input.base_T_sonar * reading.base_T_sonar;
    const double range = reading.range_m;
    if (!(range <= params.sonar_stop_range_m)) {
      continue;
    }
    if (input.scan != nullptr) {
      const double explained = lidar_range_in_cone(base_T_transducer, input.sonar->cone_half_angle_rad, seen_by_lidar);
      if (explained <= range + params.sonar_slack_m) {
        continue;
      }
    }
    points.push_back(base_T_transducer * Point2(range, 0.0));
  }
  return points;
}

SafetyVerdict supervise(const SafetyInput& input, const SafetyParams& params) {
  if (input.estop) {
    return {{}, "the emergency stop is latched"};
  }
  if (input.blocking != nullptr) {
    return {{}, input.blocking->message};
  }
  if (!input.armed) {
    return {{}, input.wanted == Twist2{} ? "" : "the motors are not armed"};
  }
  if (!std::isfinite(input.wanted.v_m_s) || !std::isfinite(input.wanted.omega_rad_s)) {
    return {{}, "the wanted velocity is not a number"};
  }
  const Twist2 clamped{std::clamp(input.wanted.v_m_s, -params.max_v_m_s, params.max_v_m_s),
                       std::clamp(input.wanted.omega_rad_s, -params.max_omega_rad_s, params.max_omega_rad_s)};
  const std::vector<Point2> points_base = obstacle_points(input, params);
  const Twist2 free = nav::limit_for_clearance(clamped, points_base, params.clearance);
  const Twist2 limited =
      input.may_be_cut ? nav::limit_for_sudden_stop(free, input.velocity, points_base, params.clearance) : free;
  const Twist2 apart = nav::limit_for_movers(limited, input.velocity, input.movers_base, params.clearance);
  const Twist2 allowed = nav::limit_rotation_while_rolling(apart, input.velocity, points_base, params.clearance);
  if (apart != limited) {
    return {allowed, "slowed for another robot"};
  }
  if (allowed != clamped) {
    return {allowed, "slowed for an obstacle"};
  }
  return {allowed, clamped == input.wanted ? "" : "clamped to the speed limits"};
}

}  // namespace seeker::app
