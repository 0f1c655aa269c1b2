#include "server/explore/look_round.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace seeker::explore {

std::optional<Twist2> LookRound::next(const Matrix3& covariance) {
  if (params_.look_round_m <= 0.0) {
    return std::nullopt;
  }
  const Matrix2 position = covariance.topLeftCorner<2, 2>();
  const double now_m2 = Eigen::SelfAdjointEigenSolver<Matrix2>(position, Eigen::EigenvaluesOnly).eigenvalues()(1);
  if (left_rad_ <= 0.0) {
    known_m2_ = after_turn_ ? now_m2 : std::min(known_m2_, now_m2);
    after_turn_ = false;
    if (now_m2 - known_m2_ < params_.look_round_m * params_.look_round_m) {
      return std::nullopt;
    }
    left_rad_ = 2.0 * kPi;
  }
  const double omega_rad_s = *std::max_element(params_.omega_rad_s.begin(), params_.omega_rad_s.end());
  left_rad_ -= omega_rad_s * params_.observation_period_s;
  after_turn_ = left_rad_ <= 0.0;
  return Twist2{0.0, omega_rad_s};
}

}  // namespace seeker::explore
