#include "server/drivers/sim/tick_gate.hpp"

#include <algorithm>

namespace seeker::drivers {

std::optional<RobotTime> TickGate::next() const {
  std::optional<RobotTime> first;
  for (const Robot& robot : robots_) {
    if (robot.state == State::kHolding) {
      return std::nullopt;
    }
    if (robot.state == State::kWaiting) {
      first = std::min(first.value_or(robot.until), robot.until);
    }
  }
  return first;
}

void TickGate::reached(RobotTime now) {
  for (Robot& robot : robots_) {
    if (robot.state == State::kWaiting && robot.until <= now) {
      robot.state = State::kHolding;
    }
  }
}

}  // namespace seeker::drivers
