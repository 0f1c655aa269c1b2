/// \file
/// Scatters the bits of a number: the hash behind patterns that need no memory.
#pragma once

#include <cstdint>

namespace seeker::sim {

/// The function splitmix64.
[[nodiscard]] constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

}  // namespace seeker::sim
