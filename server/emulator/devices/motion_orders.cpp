#include "server/emulator/devices/motion_orders.hpp"

#include <algorithm>
#include <cstdlib>

#include "common/core/angle.hpp"

namespace seeker::emulator {
namespace {

using p2os::CommandId;

Twist2 twist_of(const p2os::WheelSpeeds& speeds, const p2os::PioneerModel& model) {
  const double unit_m_s = model.vel2_divisor_mm_s * p2os::kMetre;
  return {(speeds.right + speeds.left) / 2.0 * unit_m_s,
          (speeds.right - speeds.left) / 2.0 * unit_m_s * model.rotation_rad_per_m};
}

}  // namespace

bool obey_motion(const p2os::Command& command, const p2os::PioneerModel& model, const Pose2& odom_T_base,
                 PioneerMotion& motion) {
  const int value = command.integer().value_or(0);
  switch (static_cast<CommandId>(command.number)) {
    case CommandId::kMove: motion.move(value * p2os::kMetre); return true;
    case CommandId::kVel: motion.set_velocity(value * p2os::kMetre); return true;
    case CommandId::kRotate:
    case CommandId::kRotVel: motion.set_rotation(deg_to_rad(value)); return true;
    case CommandId::kHead: motion.rotate_to(deg_to_rad(value)); return true;
    case CommandId::kDeltaHead: motion.rotate_to(odom_T_base.theta_rad + deg_to_rad(value)); return true;
    case CommandId::kVel2: motion.set_both(twist_of(p2os::vel2_speeds(value), model)); return true;
    case CommandId::kStop: motion.stop(); return true;
    case CommandId::kEStop: motion.halt(); return true;
    default: return false;
  }
}

bool obey_limit(const p2os::Command& command, const P2osDeviceParams& params, PioneerLimits& limits) {
  const int value = command.integer().value_or(0);
  if (value == 0) {
    return false;
  }
  const double magnitude_m = std::abs(value) * p2os::kMetre;
  const double magnitude_rad = deg_to_rad(std::abs(value));
  switch (static_cast<CommandId>(command.number)) {
    case CommandId::kSetV: limits.v_max_m_s = std::min(magnitude_m, params.v_top_m_s); return true;
    case CommandId::kSetRv: limits.omega_max_rad_s = std::min(magnitude_rad, params.omega_top_rad_s); return true;
    case CommandId::kSetA: (value > 0 ? limits.acceleration_m_s2 : limits.deceleration_m_s2) = magnitude_m; return true;
    case CommandId::kSetRa:
      (value > 0 ? limits.angular_acceleration_rad_s2 : limits.angular_deceleration_rad_s2) = magnitude_rad;
      return true;
    default: return false;
  }
}

}  // namespace seeker::emulator
