#include "server/emulator/devices/pioneer_counters.hpp"

#include <cmath>

namespace seeker::emulator {
namespace {

constexpr double kMaxShownStep_m = 0.099;

std::uint16_t counter(double value_m, double unit_m) {
  return static_cast<std::uint16_t>(std::llround(value_m / unit_m) & (p2os::kPositionModulus - 1));
}

}  // namespace

void PioneerCounters::power_on(const Pose2& world_T_base) {
  set_zero(world_T_base);
  left_distance_m_ = right_distance_m_ = 0.0;
}

void PioneerCounters::set_zero(const Pose2& world_T_base) {
  world_T_odom_ = world_T_base;
  odom_T_base_ = {};
  shown_m_ = Point2::Zero();
}

void PioneerCounters::follow(const Pose2& world_T_base) {
  const Pose2 odom_T_now = inverse(world_T_odom_) * world_T_base;
  const Pose2 step = inverse(odom_T_base_) * odom_T_now;
  const double way_m = std::copysign(std::hypot(step.x_m, step.y_m), step.x_m);
  const double half_difference_m = step.theta_rad / model_.rotation_rad_per_m;
  left_distance_m_ += way_m - half_difference_m;
  right_distance_m_ += way_m + half_difference_m;
  odom_T_base_ = odom_T_now;
}

void PioneerCounters::show(p2os::Sip& sip) {
  const Point2 left = odom_T_base_.translation() - shown_m_;
  const double distance = left.norm();
  shown_m_ += distance > kMaxShownStep_m ? Point2(left * (kMaxShownStep_m / distance)) : left;
  sip.x = counter(shown_m_.x(), model_.distance_unit_m);
  sip.y = counter(shown_m_.y(), model_.distance_unit_m);
  sip.theta = static_cast<std::int16_t>(std::lround(odom_T_base_.theta_rad / p2os::kAngleUnit_rad));
}

}  // namespace seeker::emulator
