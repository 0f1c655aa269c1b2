/// \file
/// The sample of a scan started with SCAN: five bytes (protocols 3.3).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "server/protocols/rplidar/polar_sample.hpp"

namespace seeker::rplidar {

inline constexpr std::size_t kLegacyBytes = 5;
inline constexpr std::uint8_t kMaxLegacyQuality = 0x3F;
inline constexpr std::uint16_t kMaxAngleQ6 = 0x7FFF;

struct LegacySample {
  bool begins_revolution = false;
  std::uint8_t quality = 0;       ///< at most kMaxLegacyQuality
  std::uint16_t angle_q6 = 0;     ///< 1/64 degree, clockwise from the front mark; at most kMaxAngleQ6
  std::uint16_t distance_q2 = 0;  ///< 1/4 mm; 0: no echo

  friend bool operator==(const LegacySample&, const LegacySample&) = default;
};

[[nodiscard]] std::array<std::uint8_t, kLegacyBytes> encode(const LegacySample& sample);
/// The sample in the first five bytes. Nothing: they are fewer, or their check bits are wrong.
[[nodiscard]] std::optional<LegacySample> decode_legacy(std::span<const std::uint8_t> bytes);
/// The sample in SI units.
[[nodiscard]] PolarSample to_polar(const LegacySample& sample);

}  // namespace seeker::rplidar
