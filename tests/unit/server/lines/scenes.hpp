/// \file
/// Scans of simple scenes for the tests of this folder.
#pragma once

#include <cmath>

#include "common/core/angle.hpp"
#include "server/lines/line.hpp"
#include "tests/support/lines/rooms.hpp"

namespace seeker::lines {

/// A rectangle around the sensor.
inline testing::Room box_room(double x0, double y0, double x1, double y1) {
  testing::Room room;
  testing::add_polygon(room, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
  return room;
}

/// Seen without noise unless `sigma_m` says so.
inline LaserScan scan_of(const testing::Room& room, testing::ScannerModel model, double sigma_m = 0.0,
                         std::uint64_t seed = 1) {
  model.sigma_m = sigma_m;
  Rng rng(seed);
  return testing::scan_room(room, model, rng).scan;
}

/// The same readings from a scanner that rotates in the opposite direction.
inline LaserScan turned_round(const LaserScan& scan) {
  LaserScan turned = scan;
  const std::size_t n = scan.ranges_m.size();
  turned.angle_min_rad = scan.angle_rad(n - 1);
  turned.angle_step_rad = -scan.angle_step_rad;
  turned.ranges_m.assign(scan.ranges_m.rbegin(), scan.ranges_m.rend());
  turned.quality.assign(scan.quality.rbegin(), scan.quality.rend());
  return turned;
}

inline bool is_finite(const Line& line) {
  return std::isfinite(line.r_m) && std::isfinite(line.alpha_rad) && line.covariance.allFinite() &&
         line.start.allFinite() && line.end.allFinite() && std::isfinite(line.length_m) && std::isfinite(line.rms_m) &&
         std::isfinite(line.slope.value_or(0.0)) && std::isfinite(line.intercept_m.value_or(0.0));
}

}  // namespace seeker::lines
