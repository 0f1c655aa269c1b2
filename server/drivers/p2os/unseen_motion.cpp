#include "server/drivers/p2os/unseen_motion.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::drivers {
namespace {

/// For how long a velocity would have to be held to come as far as by braking from it.
double braking_s(double speed, double deceleration) {
  return deceleration > 0.0 ? std::abs(speed) / (2.0 * deceleration) : 0.0;
}

double driven_s(const Twist2& commanded, Duration unheard, Duration watchdog, const BaseLimits& limits) {
  const double braked_s = std::max(braking_s(commanded.v_m_s, limits.deceleration_m_s2),
                                   braking_s(commanded.omega_rad_s, limits.angular_deceleration_rad_s2));
  return std::min(to_seconds(unheard), to_seconds(watchdog) + braked_s);
}

}  // namespace

Pose2 halfway_unseen(const Twist2& commanded, Duration unheard, Duration watchdog, const BaseLimits& limits) {
  return integrate(commanded, driven_s(commanded, unheard, watchdog, limits) / 2.0);
}

}  // namespace seeker::drivers
