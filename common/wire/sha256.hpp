/// \file
/// SHA-256 (FIPS 180-4), by which pieces are named.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace seeker::wire {

[[nodiscard]] std::array<std::uint8_t, 32> sha256_of(std::span<const std::uint8_t> bytes);
/// Lower-case hexadecimal digits.
[[nodiscard]] std::string to_hex(std::span<const std::uint8_t> bytes);

}  // namespace seeker::wire
