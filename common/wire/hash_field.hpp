/// \file
/// SHA-256 as a field of bytes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/wire/check.hpp"

namespace seeker::wire {

[[nodiscard]] inline std::string bytes_of(const std::array<std::uint8_t, 32>& hash) {
  return {hash.begin(), hash.end()};
}

inline void read_hash(std::string_view field, const std::string& from, std::array<std::uint8_t, 32>& to, Check& check) {
  if (from.size() != to.size()) {
    check.refuse(field, Errc::kInvalidArgument, "does not have 32 bytes");
    return;
  }
  std::copy(from.begin(), from.end(), to.begin());
}

}  // namespace seeker::wire
