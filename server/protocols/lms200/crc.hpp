/// \file
/// The checksum of the SICK LMS200 (protocols 2.2). It is neither of the common CRC-16 with this generator.
#pragma once

#include <cstdint>
#include <span>

namespace seeker::lms200 {

/// Checksum over all bytes of a telegram before its checksum.
[[nodiscard]] std::uint16_t crc16(std::span<const std::uint8_t> bytes);

}  // namespace seeker::lms200
