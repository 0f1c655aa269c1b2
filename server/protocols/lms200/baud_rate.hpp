/// \file
/// The rates of the LMS200's serial line (protocols 2.3).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace seeker::lms200 {

inline constexpr std::uint32_t kPowerOnBaud = 9600;

/// All rates of the device in bits per second, the slowest first. 500000 needs an RS-422 line.
[[nodiscard]] std::span<const std::uint32_t> baud_rates();
/// Parameter of the command 0x20 that changes to this rate. Nothing: the device does not have the rate.
[[nodiscard]] std::optional<std::uint8_t> baud_mode(std::uint32_t baud);
/// The rate of that parameter. Nothing: it is none of a rate.
[[nodiscard]] std::optional<std::uint32_t> baud_of_mode(std::uint8_t mode);
/// The status block's word for a rate of the device: the divisor of 1 MHz less one, the top bit set.
[[nodiscard]] std::uint16_t baud_word(std::uint32_t baud);

}  // namespace seeker::lms200
