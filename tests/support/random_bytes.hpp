/// \file
/// Bytes without any order: what nobody can compress or guess.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/core/rng.hpp"

namespace seeker::testing {

[[nodiscard]] inline std::vector<std::uint8_t> random_bytes(Rng& rng, std::size_t count) {
  std::vector<std::uint8_t> bytes(count);
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(rng.below(256));
  }
  return bytes;
}

/// The same ones for the same seed.
[[nodiscard]] inline std::vector<std::uint8_t> random_bytes(std::uint64_t seed, std::size_t count) {
  Rng rng(seed);
  return random_bytes(rng, count);
}

}  // namespace seeker::testing
