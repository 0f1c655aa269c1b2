/// \file
/// Checks of parameters against the range each must lie in.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "common/core/result.hpp"

namespace seeker::vision {

/// A field with the range in which it must lie.
struct Bound {
  const char* name;
  double value;
  double low;
  double high;
};

/// Fails with kInvalidArgument for the first field outside its range (or not a number), naming the field and the range.
template <std::size_t N>
[[nodiscard]] Status check_bounds(const std::array<Bound, N>& bounds) {
  for (const Bound& b : bounds) {
    if (!(b.value >= b.low && b.value <= b.high)) {
      return fail(Errc::kInvalidArgument, std::string(b.name) + " is " + std::to_string(b.value) + ", allowed is " +
                                              std::to_string(b.low) + " to " + std::to_string(b.high));
    }
  }
  return {};
}

}  // namespace seeker::vision
