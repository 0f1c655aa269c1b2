#include "server/app/missions/link_watch.hpp"

#include <algorithm>

namespace seeker::app {

void LinkWatch::silent(WallTime since) {
  if (!silent_since_) {
    silent_since_ = since;
    now_ = since;
    next_ = 0;
  }
}

bool LinkWatch::end_silence() {
  const bool was_silent = silent_since_.has_value();
  silent_since_.reset();
  return was_silent;
}

std::optional<api::LinkStep> LinkWatch::due(WallTime now) {
  now_ = std::max(now_, now);
  if (!silent_since_ || next_ >= steps_.size() || now - *silent_since_ < steps_[next_].after) {
    return std::nullopt;
  }
  return steps_[next_++];
}

std::optional<api::LinkCountdown> LinkWatch::countdown() const {
  if (!silent_since_) {
    return std::nullopt;
  }
  api::LinkCountdown countdown;
  countdown.silent = now_ - *silent_since_;
  if (next_ < steps_.size()) {
    countdown.next = steps_[next_];
    countdown.left = std::max(Duration::zero(), countdown.next->after - countdown.silent);
  }
  return countdown;
}

}  // namespace seeker::app
