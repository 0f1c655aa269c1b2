#include "server/app/missions/full_rotation.hpp"

#include "common/core/angle.hpp"

namespace seeker::app {
namespace {

constexpr double kRotation_rad_s = 0.6;
/// Twice as long as the rotation takes at this rate: a robot that needs longer is kept from rotating.
constexpr double kLimit_s = 2.0 * kTwoPi / kRotation_rad_s;

}  // namespace

void FullRotation::start(const Situation& situation) {
  since_ = situation.now;
  last_rad_ = situation.odom_T_base.theta_rad;
  rotated_rad_ = 0.0;
}

Twist2 FullRotation::step(const Situation& situation) {
  const double heading_rad = situation.odom_T_base.theta_rad;
  rotated_rad_ += wrap_angle(heading_rad - last_rad_);
  last_rad_ = heading_rad;
  if (rotated_rad_ >= kTwoPi || to_seconds(situation.now - *since_) > kLimit_s) {
    cancel();
    return {};
  }
  return {0.0, kRotation_rad_s};
}

}  // namespace seeker::app
