/// \file
/// Where the base was by its odometry a little while ago: sweeps and echoes arrive later than they were taken.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::app {

class OdometryHistory {
 public:
  /// Samples whose stamp does not rise are left out; one that jumps empties the history first.
  void add(const drivers::OdometrySample& sample);
  /// The pose at the stamp, between the samples before and after it at constant speed; velocity and flags are those of
  /// the sample after it. Stamps beyond the samples that are kept get the first or the last of them. Nothing before the
  /// first add().
  [[nodiscard]] std::optional<drivers::OdometrySample> at(RobotTime stamp) const;
  /// odom_T_base at the stamp as at() has it; beyond the newest sample the base goes on with that sample's velocity,
  /// for half a second at most. Nothing before the first add().
  [[nodiscard]] std::optional<Pose2> predicted_at(RobotTime stamp) const;
  /// base_T_then: where the base was then, seen from where it is now. The same place before the first add().
  [[nodiscard]] Pose2 now_T_then(RobotTime stamp) const;

 private:
  /// Two seconds of a base that reports ten times a second: what is older is a fault long since.
  static constexpr std::size_t kKept = 20;

  std::deque<drivers::OdometrySample> samples_;
};

}  // namespace seeker::app
