#include "server/protocols/rplidar/capsule_chain.hpp"

#include <utility>

namespace seeker::rplidar {
namespace {

/// No scanner turns further than this while it takes 32 samples: a quarter turn would be over 30 Hz at 4000 samples
/// per second.
constexpr int kMaxAdvanceQ6 = kRevolutionQ6 / 4;
/// Where a whole capsule is missing, the scanner has turned twice as far; a rotor that starts gains a few degrees at
/// most from capsule to capsule.
constexpr double kMaxGrowth = 1.5;
constexpr double kStartingQ6 = 3.0 * 64.0;
/// Weight of the newest advance in the smoothed one.
constexpr double kSmoothing = 0.25;

}  // namespace

std::optional<std::array<PolarSample, kCapsuleSamples>> CapsuleChain::add(const ExpressCapsule& capsule,
                                                                          bool after_gap) {
  const std::optional<ExpressCapsule> before = std::exchange(held_, capsule);
  if (!before || after_gap || capsule.first) {
    return std::nullopt;
  }
  const int advance_q6 = (capsule.start_angle_q6 - before->start_angle_q6 + 2 * kRevolutionQ6) % kRevolutionQ6;
  if (!plausible(advance_q6)) {
    return std::nullopt;
  }
  return to_polar(*before, advance_q6);
}

bool CapsuleChain::plausible(int advance_q6) {
  if (advance_q6 > kMaxAdvanceQ6) {
    return false;
  }
  const double usual_q6 = usual_advance_q6_.value_or(advance_q6);
  // Smoothed in any case: a rotor that was misjudged at first is believed after a few capsules.
  usual_advance_q6_ = usual_q6 + kSmoothing * (advance_q6 - usual_q6);
  return advance_q6 <= kMaxGrowth * usual_q6 + kStartingQ6;
}

void CapsuleChain::reset() {
  held_.reset();
  usual_advance_q6_.reset();
}

}  // namespace seeker::rplidar
