/// \file
/// Readings of the base's gyroscope (protocols 1.7).
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/result.hpp"
#include "common/core/time.hpp"
#include "server/protocols/p2os/packet.hpp"

namespace seeker::p2os {

/// Time from one reading to the next (AriaCoda b0d02e05, src/ArAnalogGyro.cpp, handleGyroPacket).
inline constexpr Duration kGyroReadingPeriod = std::chrono::milliseconds(25);
/// Largest value of the gyroscope's converter.
inline constexpr int kGyroMaxCount = 1023;
/// Value at rest, about; each gyroscope has its own.
inline constexpr double kGyroCentreCount = 512.0;

struct GyroReading {
  std::uint16_t rate = 0;  ///< count of the converter, falling with rotation counter-clockwise
  std::uint8_t temperature = 0;

  friend bool operator==(const GyroReading&, const GyroReading&) = default;
};

/// Rotation that makes the converter's count one smaller, counter-clockwise positive. `scaler` is that of the model.
[[nodiscard]] double gyro_rad_s_per_count(double scaler);

inline constexpr std::size_t kMaxGyroReadings = 64;

/// kCorrupt: it ends before its last reading.
[[nodiscard]] Result<std::vector<GyroReading>> read_gyro(const Packet& packet);
/// The packet of at most kMaxGyroReadings readings.
[[nodiscard]] Packet write_gyro(const std::vector<GyroReading>& readings);

}  // namespace seeker::p2os
