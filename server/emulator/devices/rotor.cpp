#include "server/emulator/devices/rotor.hpp"

#include <cmath>

#include "common/core/angle.hpp"

namespace seeker::emulator {

void Rotor::advance(Duration passed, double target_hz) {
  const double passed_s = to_seconds(passed);
  wobble_rad_ = std::fmod(wobble_rad_ + kTwoPi * passed_s / params_.wobble_period_s, kTwoPi);
  const double wanted_hz = target_hz * (1.0 + params_.wobble * std::sin(wobble_rad_));
  rate_hz_ = wanted_hz + (rate_hz_ - wanted_hz) * std::exp(-passed_s / params_.lag_s);
  angle_rad_ = std::fmod(angle_rad_ + kTwoPi * rate_hz_ * passed_s, kTwoPi);
}

}  // namespace seeker::emulator
