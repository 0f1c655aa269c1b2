#include "server/drivers/p2os/base_condition.hpp"

#include <algorithm>

namespace seeker::drivers {
namespace {

bool is_charging(const p2os::Sip& sip) {
  using p2os::ChargeState;
  const auto state = static_cast<ChargeState>(sip.charge_state.value_or(static_cast<std::uint8_t>(ChargeState::kNot)));
  return (sip.flags & p2os::flag::kChargerPower) != 0 ||
         (state >= ChargeState::kBulk && state <= ChargeState::kBalance);
}

/// `value` without its part in the direction of `blocked`.
double against(double value, double blocked) {
  if (blocked > 0.0) {
    return std::min(value, 0.0);
  }
  return blocked < 0.0 ? std::max(value, 0.0) : value;
}

}  // namespace

void BaseCondition::connect() {
  front_ = rear_ = stalled_ = e_stop_ = e_stall_ = charging_ = false;
  stalled_by_ = {};
}

bool BaseCondition::update(const p2os::Sip& sip, const Twist2& commanded) {
  const BaseCondition before = *this;
  front_ = params_.use_bumpers && (sip.stall_right_front & p2os::kBumpers) != 0;
  rear_ = params_.use_bumpers && (sip.stall_left_rear & p2os::kBumpers) != 0;
  stalled_ = ((sip.stall_left_rear | sip.stall_right_front) & p2os::kWheelStalled) != 0;
  e_stop_ = (sip.flags & p2os::flag::kEStop) != 0;
  e_stall_ = (sip.flags & p2os::flag::kEStall) != 0;
  charging_ = is_charging(sip);
  if (stalled_ && !before.stalled_) {
    stalled_by_ = commanded;
  }
  return (front_ && !before.front_) || (rear_ && !before.rear_) || (stalled_ && !before.stalled_) ||
         (held() && !before.held());
}

Twist2 BaseCondition::allowed(const Twist2& wanted) const {
  if (held()) {
    return {};
  }
  Twist2 motion = wanted;
  motion.v_m_s = front_ ? std::min(motion.v_m_s, 0.0) : motion.v_m_s;
  motion.v_m_s = rear_ ? std::max(motion.v_m_s, 0.0) : motion.v_m_s;
  if (stalled_) {
    motion.v_m_s = against(motion.v_m_s, stalled_by_.v_m_s);
    // Wheels that stalled while turning on the spot were blocked by the turn.
    motion.omega_rad_s =
        stalled_by_.v_m_s == 0.0 ? against(motion.omega_rad_s, stalled_by_.omega_rad_s) : motion.omega_rad_s;
  }
  return motion;
}

std::optional<Error> BaseCondition::fault() const {
  const auto refused = [](const char* message) { return Error{Errc::kRefused, message}; };
  const auto not_ready = [](const char* message) { return Error{Errc::kNotReady, message}; };
  if (e_stop_) {
    return not_ready("the base's emergency stop is pressed; release it and switch the motors on again");
  }
  if (e_stall_) {
    return not_ready("the base's emergency circuit halted it; release the emergency stop, or press MOTORS on the base");
  }
  if (front_ || rear_) {
    return refused(front_ && rear_ ? "bumpers in front and at the rear of the base are pressed; free it by hand"
                   : front_        ? "a bumper in front of the base is pressed; drive it backwards or free it by hand"
                            : "a bumper at the rear of the base is pressed; drive it forwards or free it by hand");
  }
  if (stalled_) {
    return refused("a wheel of the base is blocked; free the wheel, or drive the other way");
  }
  if (charging_) {
    return not_ready("the base is at its charger; take it off the charger before it drives");
  }
  return std::nullopt;
}

}  // namespace seeker::drivers
