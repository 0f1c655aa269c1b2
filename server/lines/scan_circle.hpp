/// \file
/// Detection of scanners with a field of view of a full circle.
#pragma once

#include "common/core/angle.hpp"
#include "common/core/scan.hpp"

namespace seeker::lines {

struct ScanCircle {
  bool closed = false;  ///< the last beam is a neighbour of the first
  bool even = false;    ///< the step from the last beam to the first equals the others
};

[[nodiscard]] inline ScanCircle circle_of(const LaserScan& scan) {
  // Real scanners leave out a beam or two at their cut, or have the first one twice.
  constexpr double kMaxSeam = 3.5;
  constexpr double kEven = 0.02;
  const std::size_t n = scan.ranges_m.size();
  const double step = std::abs(scan.angle_step_rad);
  const double seam = kTwoPi - step * (static_cast<double>(n) - 1.0);
  return {.closed = n > 2 && std::abs(seam) <= kMaxSeam * step, .even = n > 2 && std::abs(seam - step) < kEven * step};
}

}  // namespace seeker::lines
