/// \file
/// One measured distance of an RPLIDAR in SI units, sent alone or in a capsule.
#pragma once

#include <cstdint>

#include "common/core/scan.hpp"

namespace seeker::rplidar {

/// A full turn in the scanner's units of 1/64 degree.
inline constexpr int kRevolutionQ6 = 360 * 64;
inline constexpr double kDegPerQ6 = 1.0 / 64.0;

struct PolarSample {
  double angle_cw_rad = 0.0;  ///< clockwise seen from above, from the front mark, in [0, 2 pi)
  float range_m = kNoReturn;
  std::uint8_t quality = 0;  ///< 0: no echo

  friend bool operator==(const PolarSample&, const PolarSample&) = default;
};

}  // namespace seeker::rplidar
