#include "server/slam/rotation_sense.hpp"

#include <cmath>

namespace seeker::slam {

void RotationSense::note(double by_wheels_rad, double by_scans_rad) {
  const double rotation_rad = std::abs(by_wheels_rad);
  if (rotation_rad < params_.least_rad || rotation_rad > params_.most_rad) {
    return;
  }
  if (rotated_rad_ > 2.0 * params_.enough_rad) {  // old motion counts less: a scanner may be remounted
    rotated_rad_ *= 0.5;
    squares_rad2_ *= 0.5;
    products_rad2_ *= 0.5;
  }
  rotated_rad_ += rotation_rad;
  squares_rad2_ += by_wheels_rad * by_wheels_rad;
  products_rad2_ += by_wheels_rad * by_scans_rad;
}

bool RotationSense::reversed() const {
  return rotated_rad_ >= params_.enough_rad && products_rad2_ < params_.reversed_share * squares_rad2_;
}

}  // namespace seeker::slam
