/// \file
/// LinkWatch counts the silence of the client that started a mission, and decides when an entry of the mission's link
/// policy is due. The present time is an argument.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "common/api/link_policy.hpp"

namespace seeker::app {

/// Heartbeats and link policy live on the wall clock, missions on robot time (design section 3).
using WallTime = std::chrono::steady_clock::time_point;

class LinkWatch {
 public:
  LinkWatch() = default;
  explicit LinkWatch(api::LinkSteps steps) : steps_(std::move(steps)) {}

  /// The client has been silent since then; what is known of an older silence stays.
  void silent(WallTime since);
  /// The silence is over: the policy begins again with the next one. False when it was not silent.
  bool end_silence();
  /// The next entry of the policy that is due, each once, in order. Call it again until there is none.
  [[nodiscard]] std::optional<api::LinkStep> due(WallTime now);
  /// While the client is silent: for how long, and what comes next; as of the last due().
  [[nodiscard]] std::optional<api::LinkCountdown> countdown() const;

 private:
  api::LinkSteps steps_;
  std::optional<WallTime> silent_since_;
  WallTime now_;
  std::size_t next_ = 0;  ///< of steps_
};

}  // namespace seeker::app
