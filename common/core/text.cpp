#include "common/core/text.hpp"

#include <array>
#include <cstdio>

namespace seeker {

std::string text(double value) {
  std::array<char, 352> buffer{};
  // No "-0.00".
  constexpr double kCent = 0.005;
  const double shown = value > -kCent && value < kCent ? 0.0 : value;
  const int length = std::snprintf(buffer.data(), buffer.size(), "%.2f", shown);
  return {buffer.data(), static_cast<std::size_t>(length < 0 ? 0 : length)};
}

std::string text(const Point2& p_map) { return "(" + text(p_map.x()) + ", " + text(p_map.y()) + ")"; }

}  // namespace seeker
