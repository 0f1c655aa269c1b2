/// \file
/// The few frames of one connection that must be sent in order: responses, heartbeats, hello, close.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "common/wire/frame.hpp"

namespace seeker::wire {

class Outbox {
 public:
  Outbox(std::size_t max_frames, std::size_t max_bytes) : max_frames_(max_frames), max_bytes_(max_bytes) {}

  /// Adds a frame. False: the queue is full, since the receiver does not read. One frame always fits, however large.
  [[nodiscard]] bool push(OutFrame frame) {
    if (!frames_.empty() && (frames_.size() >= max_frames_ || bytes_ + frame.size() > max_bytes_)) {
      return false;
    }
    bytes_ += frame.size();
    frames_.push_back(std::move(frame));
    return true;
  }
  /// Replaces all waiting frames by one that must be sent even when the queue is full.
  void replace_all(OutFrame frame) {
    frames_.clear();
    bytes_ = frame.size();
    frames_.push_back(std::move(frame));
  }
  [[nodiscard]] std::optional<OutFrame> pop() {
    if (frames_.empty()) {
      return std::nullopt;
    }
    OutFrame frame = std::move(frames_.front());
    frames_.pop_front();
    bytes_ -= frame.size();
    return frame;
  }
  [[nodiscard]] bool empty() const { return frames_.empty(); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  std::size_t max_frames_;
  std::size_t max_bytes_;
  std::size_t bytes_ = 0;
  std::deque<OutFrame> frames_;
};

}  // namespace seeker::wire
