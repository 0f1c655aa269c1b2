/// \file
/// Scan points with the normal of the surface they lie on.
#pragma once

#include <optional>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "server/lines/range_noise.hpp"

namespace seeker::slam {

/// A point and the unit normal of its surface, turned towards the sensor that saw it: both sides of a thin wall differ.
struct OrientedPoint {
  Point2 p;
  Point2 normal;
};

/// A neighbourhood is a few beams to either side; where that is no line, as far as the noise asks for: a stretch as
/// short as the noise is wide has no direction.
struct NormalParams {
  int neighbours = 4;      ///< beams looked at to either side
  double radius_m = 0.15;  ///< and not farther away than this, or `spacings` beam spacings
  double spacings = 4.5;
  double noise_sigmas = 10.0;  ///< reach of the second look, of the noise of the ranges there
  double max_reach_m = 0.5;    ///< of the second look
  int min_points = 4;
  double max_thickness_ratio = 0.2;     ///< smaller over larger standard deviation of the neighbourhood
  double noisy_thickness_ratio = 0.25;  ///< the same at the second look
};

/// Points of the scan in the frame `base` that lie on something like a line; the rest (edges, leaves) is left out.
/// Total least squares over the neighbouring beams, which end where the surface jumps. Without `noise` the scan itself
/// tells how noisy it is.
[[nodiscard]] std::vector<OrientedPoint> oriented_points(const LaserScan& scan, const NormalParams& params = {},
                                                         const std::optional<lines::RangeNoise>& noise = std::nullopt);

/// At most `limit` of them, evenly chosen.
[[nodiscard]] std::vector<OrientedPoint> thin_out(const std::vector<OrientedPoint>& points, std::size_t limit);

[[nodiscard]] OrientedPoint transform(const Pose2& a_T_b, const OrientedPoint& point_b);

}  // namespace seeker::slam
