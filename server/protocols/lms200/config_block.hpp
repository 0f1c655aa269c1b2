/// \file
/// The configuration of the LMS200, which it keeps in flash (protocols 2.6).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "server/protocols/lms200/measuring.hpp"

namespace seeker::lms200 {

/// The fields that decide on the measured values by name, with the defaults of an LMS200. The others are kept as they
/// came, so that writing back what was read changes nothing.
struct ConfigBlock {
  static constexpr std::size_t kBytes = 34;
  /// Bits of `availability`.
  static constexpr std::uint8_t kHighAvailability = 0x01;
  static constexpr std::uint8_t kRealTimeIndex = 0x02;
  static constexpr std::uint8_t kDazzleIgnored = 0x04;

  std::uint16_t blanking = 0;
  std::uint8_t stop_threshold = 70;
  std::uint8_t peak_threshold = 0;
  std::uint8_t availability = 0;
  std::uint8_t measuring_mode = 0;  ///< code of a MeasuringMode; devices have others too
  std::uint8_t unit = 0;            ///< code of a Unit
  std::uint8_t temporary_field = 0;
  std::uint8_t subtractive_fields = 0;
  std::uint8_t multiple_evaluation = 2;
  std::uint8_t restart = 2;
  std::uint8_t restart_time = 0;
  /// Suppressed objects, and five bytes for each of the contours A, B and C.
  std::array<std::uint8_t, 16> contours{};
  std::uint8_t pixel_evaluation = 0;
  std::uint8_t single_value_evaluation = 0;
  std::uint16_t restart_times_b_c = 0;
  std::uint16_t dazzle_multiple_evaluation = 0;

  /// Whether scans carry the real-time index.
  [[nodiscard]] bool real_time_index() const { return (availability & kRealTimeIndex) != 0; }
  friend bool operator==(const ConfigBlock&, const ConfigBlock&) = default;
};

[[nodiscard]] std::array<std::uint8_t, ConfigBlock::kBytes> encode(const ConfigBlock& block);
[[nodiscard]] ConfigBlock decode_config(std::span<const std::uint8_t, ConfigBlock::kBytes> bytes);
/// The block after its first bytes were overwritten: programs send as few as 7 of the 34. `leading` has at most
/// ConfigBlock::kBytes.
[[nodiscard]] ConfigBlock overwritten(const ConfigBlock& block, std::span<const std::uint8_t> leading);

}  // namespace seeker::lms200
