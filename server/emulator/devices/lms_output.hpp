/// \file
/// The sending side of an emulated LMS200's line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "common/core/time.hpp"

namespace seeker::emulator {

/// Sends one message after the other, each when the line is free, and knows how long that takes at the line's rate.
class LmsOutput {
 public:
  static constexpr std::size_t kMaxWaiting = 32;

  /// The message begins when the line is free, at `earliest` at the soonest. Left out where kMaxWaiting others wait.
  void send(std::vector<std::uint8_t> bytes, RobotTime earliest, std::uint32_t baud);
  /// Moves what has begun by now to `taken`.
  void release(RobotTime now, std::vector<std::uint8_t>& taken);
  /// The power is off: what waits is lost, and the line is free.
  void clear();
  /// When everything that was given to send() has left.
  [[nodiscard]] RobotTime free_at() const { return free_at_; }
  /// When the next message begins; RobotTime::max() where none waits.
  [[nodiscard]] RobotTime next_start() const;

 private:
  struct Message {
    RobotTime start;
    std::vector<std::uint8_t> bytes;
  };

  std::deque<Message> waiting_;
  RobotTime free_at_ = RobotTime::min();
};

}  // namespace seeker::emulator
