#include "server/emulator/devices/lms_resampling.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/assert.hpp"

namespace seeker::emulator {
namespace {

/// Neighbours whose ranges differ by less than this part are taken for points of one surface: at half a degree, a wall
/// that is met at over 11 degrees.
constexpr double kOneSurface = 0.045;
/// Part of a step within which a beam is the scan's own.
constexpr double kSameBeam = 1e-3;

float range_at(const LaserScan& scan, double place) {
  const auto last = static_cast<double>(scan.ranges_m.size()) - 1.0;
  if (place < -kSameBeam || place > last + kSameBeam) {
    return kNoReturn;
  }
  const double nearest = std::round(place);
  const float range_m = scan.ranges_m[static_cast<std::size_t>(nearest)];
  if (std::abs(place - nearest) <= kSameBeam) {
    return range_m;
  }
  const double below = std::floor(place);
  const float a_m = scan.ranges_m[static_cast<std::size_t>(below)];
  const float b_m = scan.ranges_m[static_cast<std::size_t>(below) + 1];
  const bool one_surface = std::isfinite(a_m) && std::isfinite(b_m) &&
                           std::abs(a_m - b_m) < static_cast<float>(kOneSurface) * std::min(a_m, b_m);
  const auto part = static_cast<float>(place - below);
  return one_surface ? a_m + part * (b_m - a_m) : range_m;
}

}  // namespace

std::vector<float> resampled(const LaserScan& scan, const lms200::Variant& variant) {
  SEEKER_ASSERT(validate(scan).has_value());
  std::vector<float> ranges_m;
  ranges_m.reserve(variant.beams());
  for (std::size_t beam = 0; beam < variant.beams(); ++beam) {
    const double angle_rad = variant.angle_min_rad() + static_cast<double>(beam) * variant.angle_step_rad();
    ranges_m.push_back(scan.ranges_m.empty() ? kNoReturn
                                             : range_at(scan, (angle_rad - scan.angle_min_rad) / scan.angle_step_rad));
  }
  return ranges_m;
}

}  // namespace seeker::emulator
