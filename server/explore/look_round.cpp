#include "server/explore/look_round.hpp"

#include <algorithm>
#include <cmath>

#include "server/explore/trail.hpp"

namespace seeker::explore {
namespace {

/// The fastest rotation that the robot may choose, to the left where both directions are as fast.
double fastest_rotation_rad_s(const OneStepParams& params) {
  double fastest_rad_s = 0.0;
  for (const double omega_rad_s : params.omega_rad_s) {
    const double gain_rad_s = std::abs(omega_rad_s) - std::abs(fastest_rad_s);
    fastest_rad_s = gain_rad_s > 0.0 || (gain_rad_s == 0.0 && omega_rad_s > 0.0) ? omega_rad_s : fastest_rad_s;
  }
  return fastest_rad_s;
}

}  // namespace

std::optional<Twist2> LookRound::next(const Matrix3& covariance) {
  const double omega_rad_s = fastest_rotation_rad_s(params_);
  if (params_.look_round_m <= 0.0 || omega_rad_s == 0.0) {
    return std::nullopt;
  }
  const double sigma_m = position_sigma_m(covariance);
  const double now_m2 = sigma_m * sigma_m;
  if (left_rad_ <= 0.0) {
    known_m2_ = after_rotation_ ? now_m2 : std::min(known_m2_, now_m2);
    after_rotation_ = false;
    if (now_m2 - known_m2_ < params_.look_round_m * params_.look_round_m) {
      return std::nullopt;
    }
    left_rad_ = 2.0 * kPi;
  }
  left_rad_ -= std::abs(omega_rad_s) * params_.observation_period_s;
  after_rotation_ = left_rad_ <= 0.0;
  return Twist2{0.0, omega_rad_s};
}

}  // namespace seeker::explore
