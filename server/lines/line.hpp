/// \file
/// A straight line in one laser scan, with everything that is known about it (spec S5.1).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"

namespace seeker::lines {

/// x cos(alpha) + y sin(alpha) = r in the frame `laser`, r >= 0, and the piece of it that was seen. Start and end are
/// in the order of increasing bearing (counter-clockwise) whichever way the scanner turns.
struct Line {
  double r_m = 0.0;
  double alpha_rad = 0.0;                ///< of the normal, from the sensor to the line, in (-pi, pi]
  Matrix2 covariance = Matrix2::Zero();  ///< of (r, alpha): spec S5.5, eqs (4)-(7)
  Point2 start{0.0, 0.0};                ///< first and last point, projected on the line
  Point2 end{0.0, 0.0};
  double start_rad = 0.0;  ///< bearings of start and end; end < start when the line crosses the cut of a full circle
  double end_rad = 0.0;
  double length_m = 0.0;
  std::optional<double> slope;  ///< kappa and b of y = kappa x + b; nothing for a vertical line
  std::optional<double> intercept_m;
  std::size_t first_beam = 0;  ///< the beams of start and end, counter-clockwise; first > last across the cut
  std::size_t last_beam = 0;
  int points = 0;      ///< inliers that were fitted
  double rms_m = 0.0;  ///< of the inliers' distances: E_l of spec S5.4
};

/// No line: an entry of ScanLines::line_of_beam.
inline constexpr std::int32_t kNoLine = -1;

/// What an extractor found in one scan.
struct ScanLines {
  std::vector<Line> lines;                 ///< counter-clockwise by start
  std::vector<std::int32_t> line_of_beam;  ///< per beam the index of its line, or kNoLine
  double range_sigma_m = 0.0;              ///< noise the extractor worked with: given, or estimated from this scan
};

}  // namespace seeker::lines
