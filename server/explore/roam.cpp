#include "server/explore/roam.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::explore {
namespace {

/// Clear means this much more than near, so that noise does not make it waver.
constexpr double kClearFactor = 1.25;
/// Farther obstacles do not make a side freer.
constexpr double kSideRange_m = 3.0;

/// Room to the left less room to the right: sums of capped ranges.
double left_is_freer(const StrategyInput& input) {
  double balance_m = 0.0;
  if (input.laser != nullptr) {
    for (std::size_t k = 0; k < input.laser->ranges_m.size(); ++k) {
      const double angle_rad = input.laser->base_T_laser.theta_rad + input.laser->angle_rad(k);
      const double range_m = std::min(static_cast<double>(input.laser->ranges_m[k]), kSideRange_m);
      balance_m += std::sin(angle_rad) > 0.0 ? range_m : -range_m;
    }
  } else if (input.sonar != nullptr) {
    for (const SonarReading& reading : input.sonar->readings) {
      const double range_m = std::min(static_cast<double>(reading.range_m), kSideRange_m);
      balance_m += std::sin(reading.base_T_sonar.theta_rad) > 0.0 ? range_m : -range_m;
    }
  }
  return balance_m;
}

}  // namespace

RoamStrategy::RoamStrategy(const RoamParams& params, const nav::ClearanceParams& clearance)
    : params_(params), clearance_(clearance) {}

/// From the robot's edge on a straight line to what stands there, and to ground that no part of it may enter.
double RoamStrategy::free_distance_m(const StrategyInput& input, const std::vector<Point2>& points_base) const {
  const double free_m = nav::free_arc_m({params_.v_m_s, 0.0}, points_base, clearance_);
  double allowed_m = clearance_.horizon_m;
  for (const double side : {-1.0, 0.0, 1.0}) {
    const Point2 from_map = input.map_T_base * Point2(0.0, side * clearance_.radius_m);
    const auto forbidden_m = nav::distance_to_forbidden(input.floors.areas(), from_map, input.map_T_base.theta_rad,
                                                        clearance_.horizon_m + clearance_.radius_m);
    allowed_m = std::min(allowed_m, forbidden_m.value_or(2.0 * clearance_.horizon_m) - clearance_.radius_m);
  }
  return std::min(free_m, allowed_m);
}

StrategyStep RoamStrategy::step(const StrategyInput& input) {
  const std::vector<Point2> points_base = nav::obstacles_in_base(input);
  const double free_m = free_distance_m(input, points_base);
  const double before_rad_s = rotation_rad_s_;
  if (rotation_rad_s_ == 0.0 && free_m < params_.clear_m) {
    rotation_rad_s_ = left_is_freer(input) >= 0.0 ? params_.omega_rad_s : -params_.omega_rad_s;
  } else if (rotation_rad_s_ != 0.0 && free_m > kClearFactor * params_.clear_m) {
    rotation_rad_s_ = 0.0;
  }
  StrategyStep out;
  const bool turning = rotation_rad_s_ != 0.0;
  out.phase = turning ? "turn" : "drive";
  out.activity = turning ? "rotating until the path is clear" : "driving straight until an obstacle is near";
  out.command =
      turning ? Twist2{0.0, rotation_rad_s_} : nav::limit_for_clearance({params_.v_m_s, 0.0}, points_base, clearance_);
  if (before_rad_s != rotation_rad_s_ || !started_) {
    started_ = true;
    out.step_done = true;
    ExploreDecision decision;
    decision.rule = "roam";
    DecisionCandidate candidate;
    candidate.map_T_base = input.map_T_base;
    candidate.control = out.command;
    decision.candidates.push_back(candidate);
    decision.chosen = 0;
    decision.why = out.activity;
    out.decision = std::move(decision);
  }
  return out;
}

void RoamStrategy::interrupted(RobotTime /*now*/) { rotation_rad_s_ = 0.0; }

void RoamStrategy::transform(const MapMove& /*move*/) {}  // it knows no place

}  // namespace seeker::explore
