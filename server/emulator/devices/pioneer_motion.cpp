#include "server/emulator/devices/pioneer_motion.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::emulator {
namespace {

/// Nearer than this an aim is reached.
constexpr double kReached_m = 0.005;
constexpr double kReached_rad = deg_to_rad(0.5);
/// Velocity for what is left to an aim, in 1/s, and the part of the deceleration that braking before it counts on.
constexpr double kApproach_1_s = 2.0;
constexpr double kBraking = 0.5;

/// Velocity with which an aim at this distance can be reached without passing it.
double approach(double left, double most, double deceleration) {
  const double speed =
      std::min({most, std::sqrt(2.0 * kBraking * deceleration * std::abs(left)), kApproach_1_s * std::abs(left)});
  return std::copysign(speed, left);
}

double ramp(double present, double wanted, double acceleration, double deceleration, double dt_s) {
  const bool faster = present * wanted >= 0.0 && std::abs(wanted) > std::abs(present);
  const double change = (faster ? acceleration : deceleration) * dt_s;
  return present + std::clamp(wanted - present, -change, change);
}

}  // namespace

void PioneerMotion::leave_wheels() {
  if (both_) {
    wanted_ = {};
    both_ = false;
  }
}

void PioneerMotion::set_velocity(double v_m_s) {
  leave_wheels();
  wanted_.v_m_s = v_m_s;
  moving_ = false;
}

void PioneerMotion::set_rotation(double omega_rad_s) {
  leave_wheels();
  wanted_.omega_rad_s = omega_rad_s;
  turning_ = false;
}

void PioneerMotion::set_both(const Twist2& velocity) {
  wanted_ = velocity;
  both_ = true;
  moving_ = turning_ = false;
}

void PioneerMotion::move(double distance_m) {
  leave_wheels();
  wanted_.v_m_s = 0.0;
  left_m_ = distance_m;
  moving_ = true;
}

void PioneerMotion::rotate_to(double theta_rad) {
  leave_wheels();
  wanted_.omega_rad_s = 0.0;
  aim_rad_ = wrap_angle(theta_rad);
  turning_ = true;
}

void PioneerMotion::stop() {
  wanted_ = {};
  both_ = moving_ = turning_ = false;
}

void PioneerMotion::halt() {
  stop();
  present_ = {};
}

bool PioneerMotion::wants_to_move() const { return moving_ || turning_ || !(wanted_ == Twist2{}); }

int PioneerMotion::direction() const {
  const double way = moving_ ? left_m_ : wanted_.v_m_s;
  return way > 0.0 ? 1 : (way < 0.0 ? -1 : 0);
}

double PioneerMotion::wanted_v_m_s(const Pose2& odom_T_base) {
  if (!moving_) {
    return std::clamp(wanted_.v_m_s, -limits_.v_max_m_s, limits_.v_max_m_s);
  }
  const Pose2 way = inverse(last_) * odom_T_base;
  left_m_ -= way.x_m;
  moving_ = std::abs(left_m_) > kReached_m;
  return moving_ ? approach(left_m_, limits_.v_max_m_s, limits_.deceleration_m_s2) : 0.0;
}

double PioneerMotion::wanted_omega_rad_s(const Pose2& odom_T_base) {
  if (!turning_) {
    return std::clamp(wanted_.omega_rad_s, -limits_.omega_max_rad_s, limits_.omega_max_rad_s);
  }
  const double left_rad = wrap_angle(aim_rad_ - odom_T_base.theta_rad);
  turning_ = std::abs(left_rad) > kReached_rad;
  return turning_ ? approach(left_rad, limits_.omega_max_rad_s, limits_.angular_deceleration_rad_s2) : 0.0;
}

Twist2 PioneerMotion::step(const Pose2& odom_T_base, double dt_s, Power power) {
  Twist2 wanted{wanted_v_m_s(odom_T_base), wanted_omega_rad_s(odom_T_base)};
  last_ = odom_T_base;
  if (power == Power::kOff) {
    present_ = {};
    return present_;
  }
  if (power == Power::kHold) {
    wanted = {};
  }
  present_.v_m_s = ramp(present_.v_m_s, wanted.v_m_s, limits_.acceleration_m_s2, limits_.deceleration_m_s2, dt_s);
  present_.omega_rad_s = ramp(present_.omega_rad_s, wanted.omega_rad_s, limits_.angular_acceleration_rad_s2,
                              limits_.angular_deceleration_rad_s2, dt_s);
  return present_;
}

}  // namespace seeker::emulator
