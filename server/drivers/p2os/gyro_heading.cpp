#include "server/drivers/p2os/gyro_heading.hpp"

#include <cmath>
#include <utility>

namespace seeker::drivers {
namespace {

/// Readings of one average: 1 s.
constexpr std::size_t kRestReadings = 40;
/// A reading this far from the average being taken is motion that the wheels have not shown yet
/// (AriaCoda b0d02e05, src/ArAnalogGyro.cpp: 0.5 % of the value).
constexpr double kRestSpread = 2.56;
/// Part of a time that the readings may cover too little or too much, from the jitter of the line.
constexpr double kCoverTolerance = 0.4;

}  // namespace

void GyroHeading::learn(double count, bool at_rest) {
  const bool fits =
      rest_readings_ == 0 || std::abs(rest_sum_ / static_cast<double>(rest_readings_) - count) <= kRestSpread;
  if (!at_rest || !fits) {
    rest_sum_ = 0.0;
    rest_readings_ = 0;
    return;
  }
  rest_sum_ += count;
  if (++rest_readings_ == kRestReadings) {
    rest_count_ = rest_sum_ / static_cast<double>(kRestReadings);
    rest_sum_ = 0.0;
    rest_readings_ = 0;
  }
}

void GyroHeading::add(std::span<const p2os::GyroReading> readings, bool at_rest) {
  for (const p2os::GyroReading& reading : readings) {
    learn(reading.rate, at_rest);
    if (rest_count_) {
      rotation_rad_ -= (reading.rate - *rest_count_) * rad_s_per_count_ * to_seconds(p2os::kGyroReadingPeriod);
      covered_ += p2os::kGyroReadingPeriod;
    }
  }
}

std::optional<double> GyroHeading::take_rotation_rad(Duration time) {
  const double rotation_rad = std::exchange(rotation_rad_, 0.0);
  const Duration covered = std::exchange(covered_, Duration{0});
  if (covered == Duration{0} || std::abs(to_seconds(covered - time)) > kCoverTolerance * to_seconds(time)) {
    return std::nullopt;
  }
  return rotation_rad;
}

}  // namespace seeker::drivers
