/// \file
/// Frames that wait to be sent to a peer that makes one request at a time.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "common/wire/frame.hpp"

namespace seeker::net {

/// A bounded queue, oldest frame first. push() detects a peer that makes requests without reading the replies.
class FrameQueue {
 public:
  explicit FrameQueue(std::size_t most) : most_(most) {}

  /// Adds a frame. False where the queue is full; the frame is not added then.
  [[nodiscard]] bool push(wire::OutFrame frame) {
    if (frames_.size() >= most_) {
      return false;
    }
    frames_.push_back(std::move(frame));
    return true;
  }
  /// Removes the oldest frame; the handler Connection::Handlers::next_frame.
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
