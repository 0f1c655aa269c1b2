/// \file
/// Turns round where the robot's position has become less certain, so that what lies behind it ties down what lies
/// ahead.
#pragma once

#include <optional>

#include "common/core/pose2.hpp"
#include "server/explore/one_step_params.hpp"

namespace seeker::explore {

/// A scanner that looks ahead loses sight of what the robot has passed before it sees the next walls well: between two
/// doors of a corridor only the wheels tell the way, and what they were off by stays in the map. One turn on the spot,
/// which costs no certainty, shows both sides from one place.
class LookRound {
 public:
  explicit LookRound(const OneStepParams& params) : params_(params) {}

  /// At a decision, with the covariance of (x, y, theta): the control of the next part of a turn. Nothing: none is due.
  [[nodiscard]] std::optional<Twist2> next(const Matrix3& covariance);
  /// The turn, if there is one, is over.
  void cancel() { left_rad_ = 0.0; }

 private:
  OneStepParams params_;
  double left_rad_ = 0.0;  ///< of the present turn
  double known_m2_ = 0.0;  ///< largest variance of the position after the last turn, or the least since
  bool after_turn_ = false;
};

}  // namespace seeker::explore
