/// \file
/// Robot time: what missions, commands and sensor stamps are expressed in. It is the monotonic clock with
/// hardware and the lockstep clock with the simulator or a replay; it is never the wall clock.
#pragma once

#include <chrono>
#include <cstdint>

namespace seeker {

using Duration = std::chrono::nanoseconds;

/// Tag clock: gives RobotTime its own type. It has no now(): the present time is always an argument.
struct RobotClockTag {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<RobotClockTag, duration>;
  static constexpr bool is_steady = true;
};

/// A point in robot time; zero is the moment the robot's clock started.
using RobotTime = RobotClockTag::time_point;

[[nodiscard]] constexpr double to_seconds(Duration d) { return std::chrono::duration<double>(d).count(); }
[[nodiscard]] constexpr double to_seconds(RobotTime t) { return to_seconds(t.time_since_epoch()); }
/// Rounds to the nearest nanosecond.
[[nodiscard]] constexpr Duration seconds(double s) {
  return Duration(static_cast<std::int64_t>(s * 1e9 + (s >= 0 ? 0.5 : -0.5)));
}
[[nodiscard]] constexpr RobotTime robot_time_s(double s) { return RobotTime(seconds(s)); }

}  // namespace seeker
