/// \file
/// Rotation on the spot when the position has become less certain, so that observations of the walls behind the robot
/// reduce the uncertainty of the walls ahead.
#pragma once

#include <optional>

#include "common/core/pose2.hpp"
#include "server/explore/one_step_params.hpp"

namespace seeker::explore {

/// Decides when the robot rotates once on the spot. A scanner that looks ahead loses sight of the passed walls before
/// it sees the next walls well: between two doors of a corridor only odometry gives the distance, and its error stays
/// in the map. One rotation on the spot adds no position error and shows both sides from one place.
class LookRound {
 public:
  explicit LookRound(const OneStepParams& params) : params_(params) {}

  /// Call at each decision with the covariance of (x, y, theta): the control for the next part of a rotation. Nothing:
  /// no rotation is due.
  [[nodiscard]] std::optional<Twist2> next(const Matrix3& covariance);
  /// Ends the present rotation, if there is one.
  void cancel() { left_rad_ = 0.0; }

 private:
  OneStepParams params_;
  double left_rad_ = 0.0;  ///< angle left of the present rotation
  double known_m2_ = 0.0;  ///< largest variance of the position after the last rotation, or the smallest since then
  bool after_rotation_ = false;
};

}  // namespace seeker::explore
