/// \file
/// Numbers of several bytes in telegrams of the LMS200: the low byte comes first (protocols, introduction).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/assert.hpp"

namespace seeker::lms200 {

/// The number at `at`, which must lie inside.
[[nodiscard]] inline std::uint16_t u16_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  SEEKER_ASSERT(at + 2 <= bytes.size());
  return static_cast<std::uint16_t>(bytes[at] | (bytes[at + 1] << 8));
}

inline void append_u16(std::vector<std::uint8_t>& bytes, std::uint16_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
}

/// Overwrites the two bytes at `at`, which must lie inside.
inline void put_u16(std::span<std::uint8_t> bytes, std::size_t at, std::uint16_t value) {
  SEEKER_ASSERT(at + 2 <= bytes.size());
  bytes[at] = static_cast<std::uint8_t>(value & 0xFF);
  bytes[at + 1] = static_cast<std::uint8_t>(value >> 8);
}

}  // namespace seeker::lms200
