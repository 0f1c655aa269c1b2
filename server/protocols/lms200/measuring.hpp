/// \file
/// What the numbers in a scan of the LMS200 mean: unit, measuring mode, and variant (protocols 2.3, 2.6, 2.7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "common/core/scan.hpp"

namespace seeker::lms200 {

/// Unit of ranges, as coded in configuration, status block and scans.
enum class Unit : std::uint8_t { kCentimetre = 0, kMillimetre = 1, kDecimetre = 2 };
/// Nothing: no unit has this code.
[[nodiscard]] std::optional<Unit> unit_of(std::uint8_t code);
[[nodiscard]] double metres(Unit unit);
[[nodiscard]] std::string to_string(Unit unit);

/// How a word of 16 bits is shared between range (low bits) and flags (high bits). The ranges stated are those in mm.
enum class MeasuringMode : std::uint8_t {
  k8mFieldsAbDazzle = 0x00,
  k8mReflector = 0x01,
  k8mFieldsAbc = 0x02,
  k16mReflector = 0x03,
  k16mFieldsAb = 0x04,
  k32mReflector = 0x05,
  k32mFieldA = 0x06,
  k32m = 0x0F,
  kReflectivity = 0x3F,  ///< the words are no ranges
};
/// Nothing: no mode has this code.
[[nodiscard]] std::optional<MeasuringMode> measuring_mode_of(std::uint8_t code);
/// Number of bits of a word that hold the value.
[[nodiscard]] int value_bits(MeasuringMode mode);
[[nodiscard]] inline std::uint16_t value_mask(MeasuringMode mode) {
  return static_cast<std::uint16_t>((1U << value_bits(mode)) - 1U);
}
/// The smallest value that is a code: this one and all above (measured beyond the limit, overflow, dazzle, invalid) are
/// no returns.
[[nodiscard]] std::uint16_t first_special_value(MeasuringMode mode);
/// No range reaches this one, in metres.
[[nodiscard]] double range_limit_m(MeasuringMode mode, Unit unit);

/// Range of a word in metres, its flags removed. kNoReturn for codes, and for 0, which the device sends where it
/// measured nothing.
[[nodiscard]] float range_of(std::uint16_t word, MeasuringMode mode, Unit unit);
/// Flag bits of a word, shifted down to bit 0: fields in the order A, B, then C or dazzle; or the reflector's grade.
[[nodiscard]] std::uint8_t flags_of(std::uint16_t word, MeasuringMode mode);
/// The word of a range in metres, at least 0, rounded to the unit: the first special value for kNoReturn and for what
/// lies beyond the mode's limit. `flags` has at most 16 - value_bits() bits.
[[nodiscard]] std::uint16_t word_of(float range_m, std::uint8_t flags, MeasuringMode mode, Unit unit);

/// Field of view and resolution.
struct Variant {
  std::uint16_t angle_deg = 180;        ///< 100 or 180
  std::uint16_t resolution_cdeg = 100;  ///< 25, 50 or 100 hundredths of a degree

  [[nodiscard]] std::size_t beams() const;
  /// Direction of the first beam, the rightmost one, with the x axis ahead.
  [[nodiscard]] double angle_min_rad() const;
  /// Beams follow counter-clockwise.
  [[nodiscard]] double angle_step_rad() const;
  /// Rotations of the mirror in a scan: each covers whole degrees, at another fraction of a degree.
  [[nodiscard]] int mirror_rotations() const;
  friend bool operator==(const Variant&, const Variant&) = default;
};
/// Whether the device has this variant: 180 with 1 or 0.5 degrees, 100 with 1, 0.5 or 0.25 degrees.
[[nodiscard]] bool is_variant(const Variant& variant);
[[nodiscard]] std::string to_string(const Variant& variant);

}  // namespace seeker::lms200
