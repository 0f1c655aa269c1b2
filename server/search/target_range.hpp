/// \file
/// How far away is what the camera sees in a direction: lidar where fitted, else sonar (spec S3.5).
#pragma once

#include <optional>

#include "common/core/scan.hpp"
#include "server/search/detection_params.hpp"
#include "server/search/search_types.hpp"

namespace seeker::search {

/// Distance from the camera to the nearest surface in one direction.
struct RangeReading {
  double range_m = 0.0;
  double sigma_m = 0.0;
  RangeSource source = RangeSource::kNone;
};

/// Median of the laser returns within lidar_window_rad of the bearing, as seen from the camera.
[[nodiscard]] std::optional<RangeReading> lidar_range(const LaserScan& scan, double bearing_base_rad,
                                                      const DetectionParams& params);

/// Interpolated between the two transducers beside the bearing, or that of the one whose cone holds it. Nothing beyond
/// the ring's ends (+-90 deg and half a cone), nor where the neighbours disagree by more than half a metre.
[[nodiscard]] std::optional<RangeReading> sonar_range(const SonarScan& scan, double bearing_base_rad,
                                                      const DetectionParams& params);

/// The best there is; either scan may be null. `hint_m` (from the apparent size) vetoes ranges that are of other
/// things.
[[nodiscard]] std::optional<RangeReading> range_in_direction(double bearing_base_rad, const LaserScan* laser,
                                                             const SonarScan* sonar, std::optional<double> hint_m,
                                                             const DetectionParams& params);

/// Direction of the middle of a solid thing's outline in the sweep: what a camera recognises is one of its faces, which
/// from near lies well beside the middle. Beams are followed from the one at the bearing to both sides up to a jump;
/// nothing where that outline does not fit a thing `width_m` across (a wall it touches, half of it hidden).
[[nodiscard]] std::optional<double> outline_bearing(const LaserScan& scan, double bearing_base_rad, double range_m,
                                                    double width_m, const DetectionParams& params);

}  // namespace seeker::search
