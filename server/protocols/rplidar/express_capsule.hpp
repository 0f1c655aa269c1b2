/// \file
/// The capsule of a scan started with EXPRESS_SCAN: 32 samples in 84 bytes (protocols 3.4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "server/protocols/rplidar/polar_sample.hpp"

namespace seeker::rplidar {

inline constexpr std::size_t kCapsuleBytes = 84;
inline constexpr std::size_t kCapsuleSamples = 32;
inline constexpr std::uint16_t kMaxCapsuleDistance_mm = 0x3FFF;
inline constexpr std::uint8_t kMaxCompensationQ3 = 0x3F;
/// Capsules have no quality: that of an echo, as the manufacturer's software gives it.
inline constexpr std::uint8_t kCapsuleQuality = 0x2F;

struct CapsuleSample {
  std::uint16_t distance_mm = 0;     ///< at most kMaxCapsuleDistance_mm; 0: no echo
  std::uint8_t compensation_q3 = 0;  ///< 1/8 degree, taken away from the angle; at most kMaxCompensationQ3

  friend bool operator==(const CapsuleSample&, const CapsuleSample&) = default;
};

struct ExpressCapsule {
  bool first = false;                ///< the first one after the request
  std::uint16_t start_angle_q6 = 0;  ///< 1/64 degree, clockwise; of the first sample, without its compensation
  std::array<CapsuleSample, kCapsuleSamples> samples{};

  friend bool operator==(const ExpressCapsule&, const ExpressCapsule&) = default;
};

[[nodiscard]] std::array<std::uint8_t, kCapsuleBytes> encode(const ExpressCapsule& capsule);
/// Whether the first two bytes can begin a capsule.
[[nodiscard]] bool may_begin_capsule(std::span<const std::uint8_t> bytes);
/// The capsule in the first 84 bytes. Nothing: they are fewer, or a check of theirs is wrong.
[[nodiscard]] std::optional<ExpressCapsule> decode_capsule(std::span<const std::uint8_t> bytes);
/// The samples in SI units; `advance_q6` is the angle from this capsule's start to that of the next one.
[[nodiscard]] std::array<PolarSample, kCapsuleSamples> to_polar(const ExpressCapsule& capsule, int advance_q6);

}  // namespace seeker::rplidar
