/// \file
/// LoopWatch concludes from the number of its passes whether the robot's control loop is stuck. Wall time is an
/// argument.
#pragma once

#include <cstdint>

#include "common/core/time.hpp"
#include "common/wire/liveness.hpp"

namespace seeker::server_net {

class LoopWatch {
 public:
  /// The loop counts as stuck after `patience` without a pass.
  LoopWatch(Duration patience, wire::WallTime now) : patience_(patience), passed_at_(now) {}

  /// Takes the number of passes so far; true when the last one was too long ago.
  bool stuck(std::uint64_t pass, wire::WallTime now) {
    if (pass != pass_) {
      pass_ = pass;
      passed_at_ = now;
    }
    return now - passed_at_ >= patience_;
  }

 private:
  Duration patience_;
  wire::WallTime passed_at_;
  std::uint64_t pass_ = 0;
};

}  // namespace seeker::server_net
