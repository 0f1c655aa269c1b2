/// \file
/// What an emulated LMS200 sees, and how it is set, for those who talk to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

#include "common/core/scan.hpp"
#include "server/emulator/devices/lms_device.hpp"
#include "server/protocols/lms200/commands.hpp"

namespace seeker::emulator {

/// 361 beams of half a degree whose ranges say which beam they are: beam i has first_m + i step_m.
inline LaserScan half_degree_scan(RobotTime now, float first_m, float step_m) {
  LaserScan scan;
  scan.stamp = now;
  scan.angle_min_rad = -std::numbers::pi / 2.0;
  scan.angle_step_rad = std::numbers::pi / 360.0;
  scan.range_max_m = 8.0;
  scan.ranges_m.resize(361);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    scan.ranges_m[i] = first_m + step_m * static_cast<float>(i);
  }
  return scan;
}

/// Set so that it measures in millimetres.
inline LmsDeviceParams millimetre_device() {
  LmsDeviceParams params;
  params.flash.unit = static_cast<std::uint8_t>(lms200::Unit::kMillimetre);
  return params;
}

}  // namespace seeker::emulator
