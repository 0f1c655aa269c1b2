#include "server/emulator/devices/pioneer_body.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::emulator {
namespace {

/// The two in the middle of a row of five.
constexpr std::uint8_t kMiddleBumpers = 0x0C;
/// Bits of BUMPSTALL's argument.
constexpr int kFrontStalls = 1;
constexpr int kRearStalls = 2;
constexpr std::int8_t kNoTemperature = -128;
constexpr double kTenthVolt = 0.1;
constexpr double kTenthDegree = 0.1;

std::int16_t wire(double value, double unit) { return static_cast<std::int16_t>(std::lround(value / unit)); }

}  // namespace

void PioneerBody::feel(const sim::BaseReading& reading, std::optional<double> bearing_rad,
                       const PioneerMotion& motion) {
  if (reading.bumped && !reading_.bumped) {
    contact_in_front_ = bearing_rad ? std::cos(*bearing_rad) >= 0.0 : motion.direction() >= 0;
  }
  reading_ = reading;
}

std::uint8_t PioneerBody::pressed_bumpers(bool front) const {
  if (!(front ? params_.has_front_bumpers : params_.has_rear_bumpers)) {
    return 0;
  }
  const int touched = reading_.bumped && front == contact_in_front_ ? kMiddleBumpers : 0;
  const int by_hand = front ? faults_.front_bumpers : faults_.rear_bumpers;
  return static_cast<std::uint8_t>((touched | by_hand) & p2os::kBumpers);
}

bool PioneerBody::bump_stalls(const PioneerMotion& motion, int bump_stall) const {
  return ((bump_stall & kFrontStalls) != 0 && motion.direction() > 0 && pressed_bumpers(true) != 0) ||
         ((bump_stall & kRearStalls) != 0 && motion.direction() < 0 && pressed_bumpers(false) != 0);
}

void PioneerBody::watch_for_stalls(const PioneerMotion& motion, bool driven, int bump_stall, RobotTime now) {
  if (stalled_at_ && now - *stalled_at_ < params_.stall_wait) {
    return;
  }
  const bool blocked = reading_.stalled || bump_stalls(motion, bump_stall);
  const bool active = driven && motion.wants_to_move();
  left_stalled_ = active && (blocked || faults_.left_wheel_stuck);
  right_stalled_ = active && (blocked || faults_.right_wheel_stuck);
  stalled_at_ = left_stalled_ || right_stalled_ ? std::optional(now) : std::nullopt;
}

void PioneerBody::show(p2os::Sip& sip) const {
  sip.stall_left_rear = static_cast<std::uint8_t>(pressed_bumpers(false) | (left_stalled_ ? p2os::kWheelStalled : 0));
  sip.stall_right_front = static_cast<std::uint8_t>(pressed_bumpers(true) | (right_stalled_ ? p2os::kWheelStalled : 0));
  sip.flags = static_cast<std::uint16_t>(sip.flags | (faults_.e_stop_pressed ? p2os::flag::kEStop : 0) |
                                         (faults_.charger_plugged ? p2os::flag::kChargerPower : 0));
  sip.ports = 0;
  sip.analog = sip.digital_in = sip.digital_out = 0;
  show_power(sip);
  show_motion(sip);
  sip.temperature_c = kNoTemperature;
}

void PioneerBody::show_motion(p2os::Sip& sip) const {
  const double turn_m_s = reading_.velocity.omega_rad_s / model_.rotation_rad_per_m;
  sip.left_velocity = wire(reading_.velocity.v_m_s - turn_m_s, model_.velocity_unit_m_s);
  sip.right_velocity = wire(reading_.velocity.v_m_s + turn_m_s, model_.velocity_unit_m_s);
  sip.moving = sip.left_velocity != 0 || sip.right_velocity != 0;
  sip.rotational_velocity = wire(rad_to_deg(reading_.velocity.omega_rad_s), kTenthDegree);
  sip.fault_flags = 0;
  sip.lateral_velocity = 0;
}

void PioneerBody::show_power(p2os::Sip& sip) const {
  const double battery_dv = std::max(faults_.battery_v.value_or(reading_.battery_v), 0.0) / kTenthVolt;
  sip.battery_x10 = static_cast<std::uint16_t>(std::lround(std::min(battery_dv, 65535.0)));
  sip.battery_dv = static_cast<std::uint8_t>(std::min<std::uint16_t>(*sip.battery_x10, 0xFF));
  sip.charge_state =
      static_cast<std::uint8_t>(faults_.charger_plugged ? p2os::ChargeState::kBulk : p2os::ChargeState::kNot);
}

}  // namespace seeker::emulator
