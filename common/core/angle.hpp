/// \file
/// Angles are radians everywhere in the code; degrees exist only in configuration and user interfaces (`_deg`).
#pragma once

#include <cmath>
#include <numbers>

namespace seeker {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2.0 * std::numbers::pi;

[[nodiscard]] constexpr double deg_to_rad(double deg) { return deg * (kPi / 180.0); }
[[nodiscard]] constexpr double rad_to_deg(double rad) { return rad * (180.0 / kPi); }

/// Maps an angle to (-pi, pi] (spec S0.2).
[[nodiscard]] inline double wrap_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, kTwoPi);
  return wrapped <= -kPi ? wrapped + kTwoPi : wrapped;
}

}  // namespace seeker
