/// \file
/// Range of what the camera sees in a direction: from the lidar where fitted, otherwise from the sonars (spec S3.5).
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

/// Range interpolated between the two transducers beside the bearing, or the range of the one whose cone contains it.
/// Nothing: the bearing lies beyond the ring's ends (+-90 deg and half a cone: the paper's own cases at 97 and 100 deg
/// lie within), or the neighbours disagree by more than half a metre.
[[nodiscard]] std::optional<RangeReading> sonar_range(const SonarScan& scan, double bearing_base_rad,
                                                      const DetectionParams& params);

/// The most accurate range that is available in the direction: lidar, then sonar; either scan may be null. A range that
/// does not agree with `hint_m` (from the apparent size) belongs to another object and is rejected.
[[nodiscard]] std::optional<RangeReading> range_in_direction(double bearing_base_rad, const LaserScan* laser,
                                                             const SonarScan* sonar, std::optional<double> hint_m,
                                                             const DetectionParams& params);

/// Bearing of the middle of a solid object's outline in the sweep. A camera recognises one of its faces, which from
/// nearby lies well beside the middle. Beams are followed from the one at the bearing to both sides up to a range jump.
/// Nothing: the outline does not fit an object `width_m` across (a wall that it touches, or half of it hidden).
[[nodiscard]] std::optional<double> outline_bearing(const LaserScan& scan, double bearing_base_rad, double range_m,
                                                    double width_m, const DetectionParams& params);

}  // namespace seeker::search
