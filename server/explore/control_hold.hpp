/// \file
/// Holds one control for an observation period (spec S1.11, S1.13). In stop-and-go operation the robot stands still
/// afterwards.
#pragma once

#include <optional>

#include "server/explore/explore_params.hpp"
#include "server/explore/strategy.hpp"

namespace seeker::explore {

class ControlHold {
 public:
  ControlHold(const OneStepParams& params, const nav::ClearanceParams& clearance);

  void start(const Twist2& control, RobotTime now);
  /// Drops the present control; the robot comes to a halt first.
  void cancel(RobotTime now);
  /// True when it is time for the next decision.
  [[nodiscard]] bool ready(const StrategyInput& input);
  /// The control, slowed so that the base can halt before contact. The control ends when the readings leave no free
  /// distance.
  [[nodiscard]] Twist2 command(const StrategyInput& input);

 private:
  OneStepParams params_;
  nav::ClearanceParams clearance_;
  std::optional<Twist2> control_;
  RobotTime started_;
  std::optional<RobotTime> standing_since_;
  std::optional<RobotTime> blocked_since_;
};

}  // namespace seeker::explore
