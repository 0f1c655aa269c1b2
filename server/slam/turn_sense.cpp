#include "server/slam/turn_sense.hpp"

#include <cmath>

namespace seeker::slam {

void TurnSense::note(double by_wheels_rad, double by_scans_rad) {
  const double turn_rad = std::abs(by_wheels_rad);
  if (turn_rad < params_.least_rad || turn_rad > params_.most_rad) {
    return;
  }
  if (turned_rad_ > 2.0 * params_.enough_rad) {  // what was long ago counts less: a scanner may be mounted anew
    turned_rad_ *= 0.5;
    squares_rad2_ *= 0.5;
    products_rad2_ *= 0.5;
  }
  turned_rad_ += turn_rad;
  squares_rad2_ += by_wheels_rad * by_wheels_rad;
  products_rad2_ += by_wheels_rad * by_scans_rad;
}

bool TurnSense::reversed() const {
  return turned_rad_ >= params_.enough_rad && products_rad2_ < params_.reversed_share * squares_rad2_;
}

}  // namespace seeker::slam
