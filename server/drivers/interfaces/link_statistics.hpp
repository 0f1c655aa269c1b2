/// \file
/// Counts of what went over a device's line.
#pragma once

#include <cstdint>

namespace seeker::drivers {

/// Counts since the device was activated, for `seeker components` and for the cause of a fault.
struct LinkStatistics {
  std::uint64_t bytes_in = 0;
  std::uint64_t bytes_out = 0;
  std::uint64_t packets_in = 0;     ///< whole and valid
  std::uint64_t packets_bad = 0;    ///< refused: wrong checksum, impossible length or content
  std::uint64_t bytes_skipped = 0;  ///< outside any packet
  std::uint64_t connects = 0;       ///< handshakes that were completed

  friend bool operator==(const LinkStatistics&, const LinkStatistics&) = default;
};

}  // namespace seeker::drivers
