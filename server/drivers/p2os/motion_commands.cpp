#include "server/drivers/p2os/motion_commands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/angle.hpp"
#include "server/protocols/p2os/command.hpp"

namespace seeker::drivers {
namespace {

using p2os::CommandId;

/// Below this part of a unit a velocity is zero: rounding of a controller, not a wish to move.
constexpr double kLeastPart = 0.05;

/// The nearest whole number, which is not zero unless the value is almost zero.
int rounded(double value) {
  if (std::abs(value) < kLeastPart) {
    return 0;
  }
  const int nearest = static_cast<int>(std::lround(value));
  return nearest != 0 ? nearest : (value > 0.0 ? 1 : -1);
}

std::int8_t wheel(double speed_mm_s, double divisor_mm_s) {
  using Limits = std::numeric_limits<std::int8_t>;
  return static_cast<std::int8_t>(std::clamp<int>(rounded(speed_mm_s / divisor_mm_s), Limits::min(), Limits::max()));
}

}  // namespace

WireVelocity to_vel(const Twist2& velocity) {
  return {rounded(velocity.v_m_s / p2os::kMetre), rounded(rad_to_deg(velocity.omega_rad_s))};
}

WireVelocity to_vel2(const Twist2& velocity, const p2os::PioneerModel& model) {
  const double v_mm_s = velocity.v_m_s / p2os::kMetre;
  const double turn_mm_s = velocity.omega_rad_s / model.rotation_rad_per_m / p2os::kMetre;
  return {p2os::vel2_argument(
              {wheel(v_mm_s - turn_mm_s, model.vel2_divisor_mm_s), wheel(v_mm_s + turn_mm_s, model.vel2_divisor_mm_s)}),
          0};
}

void MotionCommands::connect(const p2os::PioneerModel& model, const BaseLimits& limits) {
  model_ = &model;
  limits_ = limits;
  base_moves_ = false;
  sent_.reset();
  halt();
}

void MotionCommands::want(const Twist2& velocity, RobotTime now) {
  wanted_ = {std::clamp(velocity.v_m_s, -limits_.v_max_m_s, limits_.v_max_m_s),
             std::clamp(velocity.omega_rad_s, -limits_.omega_max_rad_s, limits_.omega_max_rad_s)};
  wanted_at_ = now;
}

void MotionCommands::halt() {
  wanted_ = {};
  sent_.reset();
}

WireVelocity MotionCommands::on_wire(const Twist2& velocity) const {
  return params_.use_vel2 ? to_vel2(velocity, *model_) : to_vel(velocity);
}

void MotionCommands::send(const WireVelocity& velocity, bool all, PacketLine& line) {
  if (params_.use_vel2) {
    line.write(p2os::encode_command(CommandId::kVel2, velocity.first));
    return;
  }
  if (all || velocity.first != sent_->first) {
    line.write(p2os::encode_command(CommandId::kVel, velocity.first));
  }
  if (all || velocity.second != sent_->second) {
    line.write(p2os::encode_command(CommandId::kRotVel, velocity.second));
  }
}

void MotionCommands::pass(RobotTime now, const BaseCondition& condition, PacketLine& line) {
  if (!(wanted_ == Twist2{}) && now - wanted_at_ >= params_.command_timeout) {
    line.write(p2os::encode_command(CommandId::kStop));
    halt();
  }
  const bool from_rest = !must_repeat();
  commanded_ = condition.allowed(wanted_);
  const WireVelocity velocity = on_wire(commanded_);
  const bool repeat = !sent_ || (!from_rest && now - repeated_at_ >= params_.velocity_resend);
  if (repeat || !(velocity == *sent_)) {
    send(velocity, repeat, line);
    sent_ = velocity;
    // A change of one part does not put off the repetition of the other.
    repeated_at_ = repeat || from_rest ? now : repeated_at_;
  }
}

RobotTime MotionCommands::wake() const {
  if (!sent_) {
    return RobotTime::min();
  }
  const RobotTime repeat = must_repeat() ? repeated_at_ + params_.velocity_resend : RobotTime::max();
  return wanted_ == Twist2{} ? repeat : std::min(repeat, wanted_at_ + params_.command_timeout);
}

}  // namespace seeker::drivers
