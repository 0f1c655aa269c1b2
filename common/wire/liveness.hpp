/// \file
/// Is the other side there, and does it know that we are? Wall time is an argument.
#pragma once

#include <chrono>

#include "common/core/time.hpp"

namespace seeker::wire {

/// Wall time of this machine, monotonic.
using WallTime = std::chrono::time_point<std::chrono::steady_clock, Duration>;

struct LivenessParams {
  Duration heartbeat = std::chrono::seconds(1);   ///< something is sent at least this often
  Duration lost_after = std::chrono::seconds(3);  ///< nothing was received for so long
};

class Liveness {
 public:
  Liveness(LivenessParams params, WallTime now) : params_(params), received_(now), sent_(now) {}

  void set_params(LivenessParams params) { params_ = params; }
  void on_received(WallTime now) { received_ = now; }
  void on_sent(WallTime now) { sent_ = now; }
  /// Any frame is a sign of life, so that a heartbeat is only due on a quiet link.
  [[nodiscard]] bool heartbeat_due(WallTime now) const { return now - sent_ >= params_.heartbeat; }
  /// Longer than one and a half heartbeats without a sign of life.
  [[nodiscard]] bool stale(WallTime now) const { return now - received_ >= params_.heartbeat * 3 / 2; }
  [[nodiscard]] bool lost(WallTime now) const { return now - received_ >= params_.lost_after; }

 private:
  LivenessParams params_;
  WallTime received_;
  WallTime sent_;
};

}  // namespace seeker::wire
