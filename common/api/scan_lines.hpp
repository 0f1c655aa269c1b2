/// \file
/// The straight lines in a laser scan, as a robot reports them (spec S5).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"

namespace seeker::api {

/// One line with the seven features of spec S5.1, in the frame `laser`. Angles increase counter-clockwise.
struct ScanLine {
  double normal_rad = 0.0;            ///< theta_l: angle of the normal, from the sensor to the line
  double start_rad = 0.0;             ///< theta_sl: bearing of the start
  double end_rad = 0.0;               ///< theta_el: bearing of the end; below start_rad where the line crosses the cut
  double distance_m = 0.0;            ///< d_l: distance of the line from the sensor, along the normal
  double length_m = 0.0;              ///< l_l
  std::optional<double> slope;        ///< kappa_l of y = kappa x + b; no value for a vertical line
  std::optional<double> intercept_m;  ///< b_l of y = kappa x + b; no value for a vertical line
  Point2 start{0.0, 0.0};             ///< first and last point, projected on the line
  Point2 end{0.0, 0.0};
  int points = 0;                 ///< number of points of the fit
  double fit_error_m = 0.0;       ///< root mean square distance of the points from the line
  double distance_sigma_m = 0.0;  ///< standard deviations of distance and normal
  double normal_sigma_rad = 0.0;

  friend bool operator==(const ScanLine&, const ScanLine&) = default;
};

/// One round of the automatic adaptation of thresholds (spec S5.4).
struct LineRound {
  double gap_m = 0.0;          ///< distance between neighbours above which they are in different packets
  double corner_m = 0.0;       ///< distance from the line above which a point may be a corner
  double worst_error_m = 0.0;  ///< largest fit error of the round's lines

  friend bool operator==(const LineRound&, const LineRound&) = default;
};

/// The rounds of one packet of neighbouring points.
struct LinePacket {
  std::uint32_t first_beam = 0;
  std::uint32_t last_beam = 0;
  std::vector<LineRound> rounds;

  friend bool operator==(const LinePacket&, const LinePacket&) = default;
};

/// A scan with its lines.
struct LineReport {
  std::string extractor;  ///< name as in the field `lines.extractor` of a robot file
  LaserScan scan;
  std::vector<ScanLine> lines;      ///< counter-clockwise by start
  double range_sigma_m = 0.0;       ///< range noise at the mean range: given, or estimated from the scan
  std::vector<LinePacket> packets;  ///< of an extractor that adapts its thresholds; empty for the others

  friend bool operator==(const LineReport&, const LineReport&) = default;
};

}  // namespace seeker::api
