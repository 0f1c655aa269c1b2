/// \file
/// Decides from the times of frames whether the peer is alive and when to send a heartbeat. Wall time is an argument.
#pragma once

#include <chrono>

#include "common/core/time.hpp"

namespace seeker::wire {

/// Wall time of this machine, monotonic.
using WallTime = std::chrono::time_point<std::chrono::steady_clock, Duration>;

struct LivenessParams {
  Duration heartbeat = std::chrono::seconds(1);   ///< longest time without a frame sent
  Duration lost_after = std::chrono::seconds(3);  ///< time without a received frame after which the peer is lost
};

class Liveness {
 public:
  Liveness(LivenessParams params, WallTime now) : params_(params), received_(now), sent_(now) {}

  void set_params(LivenessParams params) { params_ = params; }
  void on_received(WallTime now) { received_ = now; }
  void on_sent(WallTime now) { sent_ = now; }
  /// Whether to send a heartbeat. Every frame counts as one, so that heartbeats are sent on a quiet link only.
  [[nodiscard]] bool heartbeat_due(WallTime now) const { return now - sent_ >= params_.heartbeat; }
  /// Time since a frame was received.
  [[nodiscard]] Duration silence(WallTime now) const { return now - received_; }
  /// Whether no frame was received for more than one and a half heartbeats.
  [[nodiscard]] bool stale(WallTime now) const { return now - received_ >= params_.heartbeat * 3 / 2; }
  [[nodiscard]] bool lost(WallTime now) const { return now - received_ >= params_.lost_after; }

 private:
  LivenessParams params_;
  WallTime received_;
  WallTime sent_;
};

}  // namespace seeker::wire
