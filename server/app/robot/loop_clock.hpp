/// \file
/// LoopClock gives other threads the robot's time and the number of passes of its loop.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>

#include "common/core/time.hpp"

namespace seeker::app {

/// Between two passes robot time that runs with the wall clock goes on, but for no longer than a pass should last, so
/// that the time of a loop that is stuck stands still. Any thread.
class LoopClock {
 public:
  using WallTime = std::chrono::steady_clock::time_point;

  /// The loop has passed and reached the tick of this time; nothing: it waits for its next tick. `runs`: its time goes
  /// on with the wall clock.
  void passed(std::optional<RobotTime> tick, WallTime wall_now, bool runs) {
    const std::lock_guard lock(mutex_);
    const RobotTime now = tick.value_or(now_);
    if (now != now_ || !runs) {
      wall_ = wall_now;
    }
    now_ = now;
    runs_ = runs;
    ++passes_;
  }
  [[nodiscard]] RobotTime now(WallTime wall_now) const {
    const std::lock_guard lock(mutex_);
    return runs_ ? now_ + std::clamp<Duration>(wall_now - wall_, Duration::zero(), kLongestPass) : now_;
  }
  [[nodiscard]] std::uint64_t passes() const {
    const std::lock_guard lock(mutex_);
    return passes_;
  }

  static constexpr Duration kLongestPass = std::chrono::milliseconds(100);

 private:
  mutable std::mutex mutex_;
  RobotTime now_;
  WallTime wall_;
  bool runs_ = false;
  std::uint64_t passes_ = 0;
};

}  // namespace seeker::app
