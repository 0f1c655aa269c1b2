#include "server/app/estimators/odometry_history.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/core/angle.hpp"

namespace seeker::app {
namespace {

/// Between two samples no base goes so far: its odometry began anew, and what was before lies elsewhere.
constexpr double kJump_m = 1.0;
constexpr double kJump_rad = 1.5;
/// A base that has been silent for longer may as well have stopped.
constexpr Duration kLongestAhead = std::chrono::milliseconds(500);

bool jumps(const Pose2& from, const Pose2& to) {
  return distance_m(from, to) > kJump_m || std::abs(wrap_angle(to.theta_rad - from.theta_rad)) > kJump_rad;
}

}  // namespace

void OdometryHistory::add(const drivers::OdometrySample& sample) {
  if (!samples_.empty() && sample.stamp <= samples_.back().stamp) {
    return;
  }
  if (!samples_.empty() && jumps(samples_.back().odom_T_base, sample.odom_T_base)) {
    samples_.clear();
  }
  samples_.push_back(sample);
  if (samples_.size() > kKept) {
    samples_.pop_front();
  }
}

std::optional<drivers::OdometrySample> OdometryHistory::at(RobotTime stamp) const {
  if (samples_.empty()) {
    return std::nullopt;
  }
  const auto after = std::find_if(samples_.begin(), samples_.end(),
                                  [&](const drivers::OdometrySample& sample) { return sample.stamp >= stamp; });
  if (after == samples_.end()) {
    return samples_.back();
  }
  if (after == samples_.begin()) {
    return samples_.front();
  }
  const drivers::OdometrySample& before = *std::prev(after);
  const double share = to_seconds(stamp - before.stamp) / to_seconds(after->stamp - before.stamp);
  const Pose2 step = inverse(before.odom_T_base) * after->odom_T_base;
  drivers::OdometrySample sample = *after;
  sample.stamp = stamp;
  sample.odom_T_base = before.odom_T_base * Pose2{share * step.x_m, share * step.y_m, share * step.theta_rad};
  return sample;
}

std::optional<Pose2> OdometryHistory::predicted_at(RobotTime stamp) const {
  if (samples_.empty()) {
    return std::nullopt;
  }
  const drivers::OdometrySample& newest = samples_.back();
  if (stamp <= newest.stamp) {
    return at(stamp)->odom_T_base;
  }
  const Duration ahead = std::min<Duration>(stamp - newest.stamp, kLongestAhead);
  return newest.odom_T_base * integrate(newest.velocity, to_seconds(ahead));
}

Pose2 OdometryHistory::now_T_then(RobotTime stamp) const {
  const std::optional<drivers::OdometrySample> then = at(stamp);
  return then ? inverse(samples_.back().odom_T_base) * then->odom_T_base : Pose2{};
}

}  // namespace seeker::app
