/// \file
/// The stream of a running scan: when each of its samples was measured, and the turns that they make.
#pragma once

#include <optional>

#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/drivers/rplidar/revolution_collector.hpp"
#include "server/protocols/rplidar/answer_reader.hpp"
#include "server/protocols/rplidar/capsule_chain.hpp"

namespace seeker::drivers {

/// Dates samples back from the arrival of their bytes: the device sends a sample, or a capsule of 32, as soon as it
/// was measured, and the line takes its time for each byte.
class ScanStream {
 public:
  explicit ScanStream(const RplidarParams& params) : revolutions_(params) {}

  /// A scan begins whose samples are `sample_period` apart, on a line that takes `byte_time` for a byte.
  void start(Duration sample_period, Duration byte_time);
  /// Takes a sample or a capsule that was read at `now` and returns the turn that it completes, if any. Other answers
  /// do not belong to a stream.
  [[nodiscard]] std::optional<LaserScan> add(const rplidar::Answer& answer, RobotTime now);

 private:
  [[nodiscard]] std::optional<LaserScan> add_capsule(const rplidar::ExpressCapsule& capsule, bool after_gap,
                                                     RobotTime measured);

  RevolutionCollector revolutions_;
  rplidar::CapsuleChain chain_;
  RobotTime held_measured_;  ///< when the last sample of the capsule that the chain holds was measured
  Duration sample_period_{};
  Duration byte_time_{};
};

}  // namespace seeker::drivers
