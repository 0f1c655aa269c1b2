/// \file
/// Rotation measured by the base's gyroscope.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "common/core/time.hpp"
#include "server/protocols/p2os/gyro_packet.hpp"

namespace seeker::drivers {

/// Sums up the rotation from step to step of the odometry. The gyroscope's value at rest drifts with its temperature,
/// so that it is averaged whenever the base stands; before the first average there is no rotation to be had.
class GyroHeading {
 public:
  /// `rad_s_per_count` as by gyro_rad_s_per_count().
  explicit GyroHeading(double rad_s_per_count) : rad_s_per_count_(rad_s_per_count) {}

  /// Readings in their order, kGyroReadingPeriod apart; `at_rest`: the wheels stand.
  void add(std::span<const p2os::GyroReading> readings, bool at_rest);
  /// Rotation since the last call, counter-clockwise, if the readings cover about this time.
  [[nodiscard]] std::optional<double> take_rotation_rad(Duration time);

  /// Average value at rest. Nothing: the base has not stood long enough yet.
  [[nodiscard]] std::optional<double> rest_count() const { return rest_count_; }

 private:
  void learn(double count, bool at_rest);

  double rad_s_per_count_;
  std::optional<double> rest_count_;
  double rest_sum_ = 0.0;  ///< of the average that is being taken
  std::size_t rest_readings_ = 0;
  double rotation_rad_ = 0.0;
  Duration covered_{0};
};

}  // namespace seeker::drivers
