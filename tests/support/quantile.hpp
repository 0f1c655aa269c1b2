/// \file
/// Quantiles of what was measured.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace seeker::testing {

/// The value below which the part `share` of the others lies: for 0 the smallest, for 0.5 the median, for 1 the
/// largest. Always one of the values, never a mean of two; there must be one.
template <class T>
[[nodiscard]] T quantile(std::vector<T> values, double share) {
  const auto last = static_cast<double>(values.size() - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * last + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace seeker::testing
