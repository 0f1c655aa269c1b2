#include "server/drivers/replay/invented_clock.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::drivers {
namespace {

/// Speeds that wheels of an indoor robot reach without effort.
constexpr double kFast_m_s = 1.0;
constexpr double kFast_rad_s = 1.5;

/// What would take longer was no motion: the odometry was reset, or carried on from another run. It stays a jump, for
/// whoever estimates poses to judge.
constexpr double kLongestMotion_s = 5.0;

std::optional<Pose2> odometry_of(const CarmenRecord& record) {
  if (const auto* odometry = std::get_if<CarmenOdometry>(&record)) {
    return odometry->odom_T_base;
  }
  return std::get<CarmenScan>(record).odom_T_base;
}

double least_time_s(const Pose2& from, const Pose2& to) {
  const double rotated_rad = std::abs(wrap_angle(to.theta_rad - from.theta_rad));
  return std::max(distance_m(from, to) / kFast_m_s, rotated_rad / kFast_rad_s);
}

}  // namespace

double InventedClock::place(const CarmenRecord& record) {
  const std::optional<Pose2> pose = odometry_of(record);
  double step_s = period_s_;
  if (pose && odom_T_base_) {
    const double least_s = least_time_s(*odom_T_base_, *pose);
    step_s = least_s <= kLongestMotion_s ? std::max(step_s, least_s) : step_s;
  }
  odom_T_base_ = pose ? pose : odom_T_base_;
  last_s_ = last_s_ ? *last_s_ + step_s : 0.0;
  return *last_s_;
}

}  // namespace seeker::drivers
