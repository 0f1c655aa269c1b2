/// \file
/// One full rotation on the spot, by which the sensors observe what lies around the robot.
#pragma once

#include <optional>

#include "server/app/missions/behaviour.hpp"

namespace seeker::app {

class FullRotation {
 public:
  void start(const Situation& situation);
  [[nodiscard]] bool active() const { return since_.has_value(); }
  /// Returns the command of this step. The rotation ends after 360 degrees, or when it takes far too long.
  [[nodiscard]] Twist2 step(const Situation& situation);
  void cancel() { since_.reset(); }

 private:
  std::optional<RobotTime> since_;
  double last_rad_ = 0.0;  ///< heading at the last step by dead reckoning, which corrections of the map leave alone
  double rotated_rad_ = 0.0;
};

}  // namespace seeker::app
