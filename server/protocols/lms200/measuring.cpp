#include "server/protocols/lms200/measuring.hpp"

#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"

namespace seeker::lms200 {
namespace {

/// The highest values of each mode that are codes (8183 to 8191 of 13 bits, protocols 2.7).
constexpr unsigned kSpecialValues = 9;
constexpr int kWordBits = 16;
constexpr std::uint16_t kWholeDegree_cdeg = 100;

}  // namespace

std::optional<Unit> unit_of(std::uint8_t code) {
  return code <= static_cast<std::uint8_t>(Unit::kDecimetre) ? std::optional(static_cast<Unit>(code)) : std::nullopt;
}

double metres(Unit unit) {
  switch (unit) {
    case Unit::kCentimetre: return 0.01;
    case Unit::kMillimetre: return 0.001;
    case Unit::kDecimetre: break;
  }
  return 0.1;
}

std::string to_string(Unit unit) {
  switch (unit) {
    case Unit::kCentimetre: return "cm";
    case Unit::kMillimetre: return "mm";
    case Unit::kDecimetre: break;
  }
  return "10 cm";
}

std::optional<MeasuringMode> measuring_mode_of(std::uint8_t code) {
  const auto mode = static_cast<MeasuringMode>(code);
  const bool known = code <= static_cast<std::uint8_t>(MeasuringMode::k32mFieldA) || mode == MeasuringMode::k32m ||
                     mode == MeasuringMode::kReflectivity;
  return known ? std::optional(mode) : std::nullopt;
}

int value_bits(MeasuringMode mode) {
  switch (mode) {
    case MeasuringMode::k8mFieldsAbDazzle:
    case MeasuringMode::k8mReflector:
    case MeasuringMode::k8mFieldsAbc: return 13;
    case MeasuringMode::k16mReflector:
    case MeasuringMode::k16mFieldsAb: return 14;
    case MeasuringMode::k32mReflector:
    case MeasuringMode::k32mFieldA: return 15;
    case MeasuringMode::k32m:
    case MeasuringMode::kReflectivity: break;
  }
  return kWordBits;
}

std::uint16_t first_special_value(MeasuringMode mode) {
  return static_cast<std::uint16_t>((1U << value_bits(mode)) - kSpecialValues);
}

double range_limit_m(MeasuringMode mode, Unit unit) { return first_special_value(mode) * metres(unit); }

float range_of(std::uint16_t word, MeasuringMode mode, Unit unit) {
  const auto value = static_cast<std::uint16_t>(word & value_mask(mode));
  const bool measured = value > 0 && value < first_special_value(mode);
  return measured ? static_cast<float>(value * metres(unit)) : kNoReturn;
}

std::uint8_t flags_of(std::uint16_t word, MeasuringMode mode) {
  return static_cast<std::uint8_t>(static_cast<unsigned>(word) >> value_bits(mode));
}

std::uint16_t word_of(float range_m, std::uint8_t flags, MeasuringMode mode, Unit unit) {
  SEEKER_ASSERT(range_m >= 0.0F && (unsigned{flags} << value_bits(mode)) <= 0xFFFFU);
  const std::uint16_t special = first_special_value(mode);
  const double units = std::round(static_cast<double>(range_m) / metres(unit));
  const std::uint16_t value = units < special ? static_cast<std::uint16_t>(units) : special;
  return static_cast<std::uint16_t>(value | (unsigned{flags} << value_bits(mode)));
}

std::size_t Variant::beams() const {
  SEEKER_ASSERT(resolution_cdeg > 0);
  return std::size_t{angle_deg} * kWholeDegree_cdeg / resolution_cdeg + 1;
}

double Variant::angle_min_rad() const { return -deg_to_rad(angle_deg) / 2.0; }

double Variant::angle_step_rad() const { return deg_to_rad(resolution_cdeg) / kWholeDegree_cdeg; }

int Variant::mirror_rotations() const {
  SEEKER_ASSERT(resolution_cdeg > 0);
  return kWholeDegree_cdeg / resolution_cdeg;
}

bool is_variant(const Variant& variant) {
  const std::uint16_t step = variant.resolution_cdeg;
  const bool common = step == 100 || step == 50;
  return (variant.angle_deg == 180 && common) || (variant.angle_deg == 100 && (common || step == 25));
}

std::string to_string(const Variant& variant) {
  const std::string step = variant.resolution_cdeg == 100  ? "1"
                           : variant.resolution_cdeg == 50 ? "0.5"
                                                           : "0." + std::to_string(variant.resolution_cdeg);
  return std::to_string(variant.angle_deg) + "/" + step + " deg";
}

}  // namespace seeker::lms200
