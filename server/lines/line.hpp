/// \file
/// A straight line in one laser scan, with its geometry, covariance and beams (spec S5.1).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "server/lines/range_noise.hpp"

namespace seeker::lines {

/// The line x cos(alpha) + y sin(alpha) = r in the frame `laser`, r >= 0, and its observed piece. Start and end are in
/// the order of increasing bearing (counter-clockwise), whichever direction the scanner rotates in.
struct Line {
  double r_m = 0.0;
  double alpha_rad = 0.0;                ///< angle of the normal, from the sensor to the line, in (-pi, pi]
  Matrix2 covariance = Matrix2::Zero();  ///< covariance of (r, alpha): spec S5.5, eqs (4)-(7)
  Point2 start{0.0, 0.0};                ///< first and last point, projected on the line
  Point2 end{0.0, 0.0};
  double start_rad = 0.0;  ///< bearings of start and end; end < start when the line crosses the cut of a full circle
  double end_rad = 0.0;
  double length_m = 0.0;
  std::optional<double> slope;        ///< kappa of y = kappa x + b; no value for a vertical line
  std::optional<double> intercept_m;  ///< b of y = kappa x + b
  std::size_t first_beam = 0;         ///< the beams of start and end, counter-clockwise; first > last across the cut
  std::size_t last_beam = 0;
  int points = 0;      ///< number of inliers of the fit
  double rms_m = 0.0;  ///< root mean square distance of the inliers: E_l of spec S5.4
};

/// The entry of ScanLines::line_of_beam for a beam without a line.
inline constexpr std::int32_t kNoLine = -1;

/// The two thresholds that the paper's detector adapts automatically (spec S5.4).
struct LineThresholds {
  double gap_m = 0.150;     ///< Delta kappa_A: neighbours farther apart are in different packets
  double corner_m = 0.025;  ///< delta_line: a point farther from the line may be a corner (the paper's mode "turn")
};

/// The adaptation of the thresholds of one packet of neighbouring points.
struct PacketHistory {
  std::size_t first_beam = 0;  ///< index of the first beam, counter-clockwise
  std::size_t last_beam = 0;
  std::vector<LineThresholds> rounds;  ///< thresholds of the rounds, in their order
  std::vector<double> worst_error_m;   ///< largest E_l of each round
};

/// The lines extracted from one scan.
struct ScanLines {
  std::vector<Line> lines;                 ///< counter-clockwise by start
  std::vector<std::int32_t> line_of_beam;  ///< per beam the index of its line, or kNoLine
  RangeNoise noise;                        ///< law of the range noise: given, or estimated from this scan
  double range_sigma_m = 0.0;              ///< `noise` at the mean range of the scan
  std::vector<PacketHistory> history;      ///< of an extractor that adapts its thresholds; empty for the others
};

}  // namespace seeker::lines
