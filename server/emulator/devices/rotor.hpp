/// \file
/// The turning head of a scanner: it runs up and down slowly, and its speed wobbles.
#pragma once

#include "common/core/time.hpp"

namespace seeker::emulator {

struct RotorParams {
  double lag_s = 0.25;           ///< time constant of its speed
  double wobble = 0.015;         ///< amplitude of its speed's wobble, relative
  double wobble_period_s = 2.7;  ///< not a whole number of turns, so that their lengths differ
};

/// Clockwise rotation. It advances in steps that its owner chooses.
class Rotor {
 public:
  explicit Rotor(const RotorParams& params) : params_(params) {}

  /// Turns for `passed` while the motor drives towards `target_hz`.
  void advance(Duration passed, double target_hz);
  /// Stands at once, where it is.
  void block() { rate_hz_ = 0.0; }

  /// Clockwise from the front mark, [0, 2 pi).
  [[nodiscard]] double angle_cw_rad() const { return angle_rad_; }
  [[nodiscard]] double rate_hz() const { return rate_hz_; }

 private:
  RotorParams params_;
  double angle_rad_ = 0.0;
  double rate_hz_ = 0.0;
  double wobble_rad_ = 0.0;  ///< phase of the wobble
};

}  // namespace seeker::emulator
