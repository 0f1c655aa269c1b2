/// \file
/// What can go wrong on a line between a device and its host.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/core/rng.hpp"

namespace seeker::emulator {

struct LineFaults {
  double bit_error_rate = 0.0;  ///< probability that a bit arrives inverted
  double lost_byte_rate = 0.0;  ///< probability that a byte does not arrive
  bool silent = false;          ///< nothing arrives in either direction
  bool wrong_baud = false;      ///< both ends use different rates: bytes arrive as others

  friend bool operator==(const LineFaults&, const LineFaults&) = default;
};

/// Carries bytes over a faulty line, in one direction. Errors come at random places, by their own generator.
class LineNoise {
 public:
  explicit LineNoise(Rng rng) : rng_(rng) {}
  [[nodiscard]] std::vector<std::uint8_t> carry(std::span<const std::uint8_t> bytes, const LineFaults& faults);

 private:
  Rng rng_;
};

}  // namespace seeker::emulator
