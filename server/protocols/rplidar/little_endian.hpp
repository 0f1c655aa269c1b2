/// \file
/// Numbers of more than one byte, low byte first as the scanner sends them (protocols 3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace seeker::rplidar {

/// The 16-bit number at `at`; both bytes must exist.
[[nodiscard]] inline std::uint16_t read_u16(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] | (bytes[at + 1] << 8));
}

/// The 32-bit number at `at`; all four bytes must exist.
[[nodiscard]] inline std::uint32_t read_u32(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint32_t>(read_u16(bytes, at)) | (static_cast<std::uint32_t>(read_u16(bytes, at + 2)) << 16);
}

inline void write_u16(std::uint16_t value, std::vector<std::uint8_t>& to) {
  to.push_back(static_cast<std::uint8_t>(value & 0xFFU));
  to.push_back(static_cast<std::uint8_t>(value >> 8));
}

inline void write_u32(std::uint32_t value, std::vector<std::uint8_t>& to) {
  write_u16(static_cast<std::uint16_t>(value & 0xFFFFU), to);
  write_u16(static_cast<std::uint16_t>(value >> 16), to);
}

}  // namespace seeker::rplidar
