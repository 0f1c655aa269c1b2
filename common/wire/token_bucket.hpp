/// \file
/// A rate limit that allows bursts.
#pragma once

#include <algorithm>

#include "common/wire/liveness.hpp"

namespace seeker::wire {

/// Starts full with `burst` tokens, refilled at `rate_per_s`.
class TokenBucket {
 public:
  TokenBucket(double rate_per_s, double burst, WallTime now)
      : rate_per_s_(rate_per_s), burst_(burst), tokens_(burst), updated_(now) {}

  /// Takes one token if there is one.
  [[nodiscard]] bool take(WallTime now) {
    tokens_ = std::min(burst_, tokens_ + rate_per_s_ * to_seconds(now - updated_));
    updated_ = now;
    if (tokens_ < 1.0) {
      return false;
    }
    tokens_ -= 1.0;
    return true;
  }

 private:
  double rate_per_s_;
  double burst_;
  double tokens_;
  WallTime updated_;
};

}  // namespace seeker::wire
