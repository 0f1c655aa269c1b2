/// \file
/// Scan points with the normal of the surface they lie on.
#pragma once

#include <optional>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "server/lines/range_noise.hpp"

namespace seeker::slam {

/// A point and the unit normal of its surface, oriented towards the sensor: both sides of a thin wall differ.
struct OrientedPoint {
  Point2 p;
  Point2 normal;
};

/// A neighbourhood consists of a few beams to either side; where these form no line, it is extended as far as the range
/// noise requires: a stretch as short as the noise is wide has no direction.
struct NormalParams {
  int neighbours = 4;      ///< number of beams to either side
  double radius_m = 0.15;  ///< largest distance of a neighbour, or `spacings` beam spacings if that is more
  double spacings = 4.5;
  /// Extent of the second, larger neighbourhood, in standard deviations of the range noise.
  double noise_sigmas = 10.0;
  double max_reach_m = 0.5;  ///< largest extent of the second neighbourhood
  int min_points = 4;
  double max_thickness_ratio = 0.2;     ///< smaller over larger standard deviation of the neighbourhood
  double noisy_thickness_ratio = 0.25;  ///< the same for the second neighbourhood
};

/// Points of the scan in the frame `base` that lie on an approximately straight line; the rest (edges, leaves) is left
/// out. Total least squares over the neighbouring beams, which end at jumps of the surface. Without `noise` the noise
/// is estimated from the scan itself.
[[nodiscard]] std::vector<OrientedPoint> oriented_points(const LaserScan& scan, const NormalParams& params = {},
                                                         const std::optional<lines::RangeNoise>& noise = std::nullopt);

/// Selects at most `limit` of the points, evenly distributed.
[[nodiscard]] std::vector<OrientedPoint> thin_out(const std::vector<OrientedPoint>& points, std::size_t limit);

[[nodiscard]] OrientedPoint transform(const Pose2& a_T_b, const OrientedPoint& point_b);

}  // namespace seeker::slam
