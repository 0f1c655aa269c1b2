/// \file
/// Lets a clock that could go faster go at a chosen speed.
#pragma once

#include <chrono>
#include <optional>

#include "common/core/tick_timing.hpp"

namespace seeker::drivers {

class Pacer {
 public:
  using WallTime = std::chrono::steady_clock::time_point;

  /// Robot seconds per wall second; 0: as fast as possible, nothing is waited for or counted. Not negative.
  explicit Pacer(double speed);

  /// Sleeps until a tick of `period` robot time after the one before has its turn. A loop that is a little late hurries
  /// to catch up, one that is more than kMaxLag late goes on from now.
  void wait(Duration period);
  /// What wait() does, as values: when a tick of `period` is due for a caller that comes at `now`, and that it began.
  [[nodiscard]] WallTime due(Duration period, WallTime now);
  void begun(WallTime now);
  /// The loop rests: the next tick begins whenever it comes.
  void rest() { due_.reset(); }

  [[nodiscard]] double speed() const { return speed_; }
  /// Nothing at speed 0.
  [[nodiscard]] std::optional<TickTiming> timing() const;

  static constexpr Duration kMaxLag = std::chrono::milliseconds(250);

 private:
  double speed_;
  std::optional<WallTime> due_;  ///< of the last tick
  TickTiming timing_;
};

}  // namespace seeker::drivers
