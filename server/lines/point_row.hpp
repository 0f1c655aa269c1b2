/// \file
/// The returns of a scan as a row of points, and lines built from indices into it, as shared by the point-by-point
/// extractors (paper, split-and-merge, IEPF).
#pragma once

#include <vector>

#include "server/lines/line.hpp"
#include "server/lines/polar_fit.hpp"
#include "server/lines/range_noise.hpp"

namespace seeker::lines {

/// Points in counter-clockwise order. On a full circle the row begins behind the widest gap, so that no line crosses
/// its ends.
struct PointRow {
  std::vector<PolarPoint> polar;
  std::vector<Point2> points;
  std::vector<std::size_t> beams;
  RangeNoise noise;
  double mean_range_m = 0.0;

  [[nodiscard]] std::size_t size() const { return points.size(); }
  /// Distance from the previous point.
  [[nodiscard]] double gap_m(std::size_t i) const { return (points[i] - points[i - 1]).norm(); }
};

/// Limits of the ranges in addition to those of the scanner.
struct RangeLimits {
  double min_m = 0.01;  ///< nearer returns are the scanner's own housing
  double max_m = 0.0;   ///< 0: the scanner's own limit
};

/// Returns within the limits with a quality above 0; the quality is the weight of a point.
[[nodiscard]] PointRow point_row(const LaserScan& scan, const NoiseParams& noise, const RangeLimits& limits = {});

/// Ascending indices into a row.
using Indices = std::vector<std::size_t>;

[[nodiscard]] LineFit fit_points(const PointRow& row, const Indices& indices);
/// Fits all quantities of a line, the covariance by eqs (4)-(7). Needs two different points.
[[nodiscard]] Line build_line(const LaserScan& scan, const PointRow& row, const Indices& indices,
                              double bearing_sigma_rad);
/// The lines in their order, with the beams of each.
[[nodiscard]] ScanLines build_lines(const LaserScan& scan, const PointRow& row, std::vector<Indices> lines,
                                    double bearing_sigma_rad);

/// Merges lines by spec S5.6: two lines are joined when their distance D (eq 12) is below `max_distance` and their
/// nearest ends are not farther apart than `max_gap_m`; repeated until no such pair is left.
[[nodiscard]] std::vector<Indices> merge_lines(const LaserScan& scan, const PointRow& row, std::vector<Indices> lines,
                                               double max_distance, double max_gap_m, double bearing_sigma_rad);

}  // namespace seeker::lines
