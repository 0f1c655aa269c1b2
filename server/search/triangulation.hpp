/// \file
/// Position of a target from bearings and ranges taken at several places: weighted least squares.
#pragma once

#include <optional>
#include <vector>

#include "common/core/pose2.hpp"

namespace seeker::search {

/// One sighting from one place. The bearing is relative to the camera's heading.
struct BearingRange {
  Pose2 map_T_camera;
  double bearing_rad = 0.0;
  double bearing_sigma_rad = 0.02;
  std::optional<double> range_m;  ///< distance to the target's centre
  double range_sigma_m = 0.1;
};

struct PositionEstimate {
  Point2 p_map = Point2::Zero();
  Matrix2 covariance = Matrix2::Zero();  ///< from the measurements alone, without the robot's pose error
  double chi2 = 0.0;                     ///< sum of squared weighted residuals
};

/// Position implied by one sighting with a range.
[[nodiscard]] PositionEstimate position_of(const BearingRange& sighting);

/// Gauss-Newton over all bearings and ranges. Without any range, at least two bearings must differ by min_parallax_rad
/// and the intersection must lie in front of all of them within max_range_m. Nothing: these conditions do not hold.
[[nodiscard]] std::optional<PositionEstimate> estimate_position(const std::vector<BearingRange>& sightings,
                                                                double min_parallax_rad, double max_range_m);

/// The contribution of the robot's pose error (common to all sightings of a short time) to the covariance: the target
/// moves rigidly with the robot, J = [I | perp(p - robot)].
[[nodiscard]] Matrix2 pose_contribution(const Point2& p_map, const Pose2& map_T_base, const Matrix3& pose_covariance);

}  // namespace seeker::search
