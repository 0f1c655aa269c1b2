/// \file
/// Decides when a world that several robots share may advance: no tick begins before all robots have finished theirs.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/core/time.hpp"

namespace seeker::drivers {

/// Holds the states of the robots, without threads or clocks. Every robot holds the world at first, so that the order
/// in which they come does not matter.
class TickGate {
 public:
  explicit TickGate(std::size_t robots) : robots_(robots) {}

  /// The robot is within its tick: the world waits for it.
  void hold(std::size_t robot) { robots_[robot] = {State::kHolding, {}}; }
  /// The robot is absent or does not tick for now: the world does not wait for it.
  void let_go(std::size_t robot) { robots_[robot] = {State::kAway, {}}; }
  /// The robot has finished its tick and continues at `until`.
  void wait(std::size_t robot, RobotTime until) { robots_[robot] = {State::kWaiting, until}; }

  /// The time to which the world may advance: the earliest one that a robot waits for. Nothing: a robot holds the
  /// world, or none waits.
  [[nodiscard]] std::optional<RobotTime> next() const;
  /// The world has advanced to `now`: the robots that waited for it hold it again.
  void reached(RobotTime now);

  [[nodiscard]] bool waiting(std::size_t robot) const { return robots_[robot].state == State::kWaiting; }

 private:
  enum class State { kHolding, kWaiting, kAway };
  struct Robot {
    State state = State::kHolding;
    RobotTime until;
  };
  std::vector<Robot> robots_;
};

}  // namespace seeker::drivers
