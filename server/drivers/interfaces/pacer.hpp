/// \file
/// Slows a clock that could run faster to a chosen speed.
#pragma once

#include <chrono>
#include <optional>

#include "common/core/tick_timing.hpp"

namespace seeker::drivers {

class Pacer {
 public:
  using WallTime = std::chrono::steady_clock::time_point;

  /// Robot seconds per wall second, not negative; 0: as fast as possible, without waiting or timing.
  explicit Pacer(double speed);

  /// From now on await() waits for the tick that is `period` of robot time after the previous one. A loop that is a
  /// little late catches up; one that is more than kMaxLag late continues from now.
  void start(Duration period);
  /// Sleeps until that tick is due, at most `limit` of wall time. False: it is not due yet.
  [[nodiscard]] bool await(Duration limit);
  /// What both do, as values: when a tick of `period` is due for a caller that comes at `now`, and the record that it
  /// began.
  [[nodiscard]] WallTime due(Duration period, WallTime now);
  void begun(WallTime now);
  /// The loop rests: the next tick is due when it comes.
  void rest() {
    due_.reset();
    awaited_ = false;
  }

  [[nodiscard]] double speed() const { return speed_; }
  /// Timing of the ticks. Nothing: the speed is 0.
  [[nodiscard]] std::optional<TickTiming> timing() const;

  static constexpr Duration kMaxLag = std::chrono::milliseconds(250);

 private:
  double speed_;
  std::optional<WallTime> due_;  ///< when the last tick was due
  bool awaited_ = false;         ///< that tick has not begun
  TickTiming timing_;
};

}  // namespace seeker::drivers
