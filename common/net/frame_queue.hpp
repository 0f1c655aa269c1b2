/// \file
/// What waits to leave a connection whose peer asks one thing at a time.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "common/wire/frame.hpp"

namespace seeker::net {

/// Oldest first, bounded: a peer that asks on without reading the answers is told by push().
class FrameQueue {
 public:
  explicit FrameQueue(std::size_t most) : most_(most) {}

  /// False where as many wait as may; the frame is not taken then.
  [[nodiscard]] bool push(wire::OutFrame frame) {
    if (frames_.size() >= most_) {
      return false;
    }
    frames_.push_back(std::move(frame));
    return true;
  }
  /// For Connection::Handlers::next_frame.
  [[nodiscard]] std::optional<wire::OutFrame> pop() {
    if (frames_.empty()) {
      return std::nullopt;
    }
    wire::OutFrame frame = std::move(frames_.front());
    frames_.pop_front();
    return frame;
  }

 private:
  std::size_t most_;
  std::deque<wire::OutFrame> frames_;
};

}  // namespace seeker::net
