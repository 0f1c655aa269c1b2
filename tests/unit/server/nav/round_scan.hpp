/// \file
/// A scan of a robot that has the same distance to everything around it.
#pragma once

#include "common/core/angle.hpp"
#include "common/core/scan.hpp"

namespace seeker::nav {

/// Full circle in half degrees; kNoReturn: nothing is in sight.
inline LaserScan round_scan(float range_m) {
  LaserScan scan;
  scan.angle_min_rad = -kPi;
  scan.angle_step_rad = deg_to_rad(0.5);
  scan.range_max_m = 10.0;
  scan.ranges_m.assign(720, range_m);
  return scan;
}

}  // namespace seeker::nav
