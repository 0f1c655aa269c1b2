#include "server/explore/control_hold.hpp"

#include <cmath>

namespace seeker::explore {
namespace {

constexpr double kStanding_m_s = 0.01;
constexpr double kStanding_rad_s = 0.02;
constexpr double kSettleLimit_s = 3.0;  ///< encoders that never come to rest do not stop the exploration
constexpr double kBlocked_s = 0.5;      ///< somebody who walks by does not end a control at once

}  // namespace

ControlHold::ControlHold(const OneStepParams& params, const nav::ClearanceParams& clearance)
    : params_(params), clearance_(clearance) {}

void ControlHold::start(const Twist2& control, RobotTime now) {
  control_ = control;
  started_ = now;
  standing_since_.reset();
  blocked_since_.reset();
}

void ControlHold::cancel(RobotTime now) {
  control_.reset();
  started_ = now;
  standing_since_.reset();
}

bool ControlHold::ready(const StrategyInput& input) {
  if (control_) {
    const bool over = to_seconds(input.now - started_) >= params_.observation_period_s;
    const bool blocked = blocked_since_ && to_seconds(input.now - *blocked_since_) >= kBlocked_s;
    if (!over && !blocked) {
      return false;
    }
    if (!params_.stop_and_go) {
      return true;
    }
    cancel(input.now);
  }
  const bool still =
      std::abs(input.velocity.v_m_s) < kStanding_m_s && std::abs(input.velocity.omega_rad_s) < kStanding_rad_s;
  if (!still && to_seconds(input.now - started_) < kSettleLimit_s) {
    standing_since_.reset();
    return false;
  }
  if (!standing_since_) {
    standing_since_ = input.now;
  }
  return to_seconds(input.now - *standing_since_) >= params_.settle_s;
}

Twist2 ControlHold::command(const StrategyInput& input) {
  if (!control_) {
    return {};
  }
  const Twist2 limited = nav::limit_for_clearance(*control_, nav::obstacles_in_base(input), clearance_);
  const bool blocked = control_->v_m_s > 0.0 && limited.v_m_s < kStanding_m_s;
  if (!blocked) {
    blocked_since_.reset();
  } else if (!blocked_since_) {
    blocked_since_ = input.now;
  }
  return blocked ? Twist2{} : limited;
}

}  // namespace seeker::explore
