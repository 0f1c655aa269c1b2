/// \file
/// Random numbers that distinguish running programs.
#pragma once

#include <cstdint>
#include <random>

namespace seeker::net {

/// A random number other than 0.
[[nodiscard]] inline std::uint64_t random_id() {
  std::random_device device;
  const std::uint64_t id = (std::uint64_t{device()} << 32U) | device();
  return id == 0 ? 1 : id;
}

}  // namespace seeker::net
