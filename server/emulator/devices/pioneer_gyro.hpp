/// \file
/// The gyroscope of an emulated base.
#pragma once

#include <vector>

#include "common/core/time.hpp"
#include "server/protocols/p2os/gyro_packet.hpp"

namespace seeker::emulator {

/// Measures at its own period. The part of a count that the converter cannot show goes into the next reading, as the
/// noise of a real one spreads readings over neighbouring counts.
class PioneerGyro {
 public:
  PioneerGyro(double scaler, double rest_count)
      : rad_s_per_count_(p2os::gyro_rad_s_per_count(scaler)), rest_count_(rest_count) {}

  /// Begins to measure.
  void start(RobotTime now);
  /// The base turns like this up to now.
  void follow(double omega_rad_s, RobotTime now);
  /// The readings since the last call.
  [[nodiscard]] std::vector<p2os::GyroReading> take();

 private:
  double rad_s_per_count_;
  double rest_count_;
  RobotTime next_;
  double carried_ = 0.0;
  std::vector<p2os::GyroReading> readings_;
};

}  // namespace seeker::emulator
