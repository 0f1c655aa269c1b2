/// \file
/// A synthetic scan with the lines of Table 1 of the line-detection paper (spec S5.7).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "common/core/rng.hpp"
#include "common/core/scan.hpp"
#include "server/lines/line.hpp"

namespace seeker::lab {

/// A row of Table 1 and the beams that show its line in the synthetic scan.
struct TableLine {
  const char* name;
  int points;           ///< P
  double slope;         ///< kappa
  double intercept_mm;  ///< b
  double printed_mean_error_mm;
  int first_beam;  ///< index of the first beam; one beam for each degree
};

/// Table 1 without L2, whose intercept is misprinted. Slopes, intercepts and numbers of points are as printed; the
/// bearings are chosen here. L3 and L4 meet in the corner (81, 1504) mm as printed. The corner of L5 and L6 lies behind
/// them, so L5 follows L4 as the wall behind it, and L6 is a piece of the line of L3, 0.47 m from it.
inline constexpr std::array kTable1{
    TableLine{"L1", 89, -1.650, -3750.0, 1.40, 168}, TableLine{"L3", 9, -1.630, 1636.0, 1.99, 79},
    TableLine{"L4", 25, 0.610, 1454.6, 1.56, 88}, TableLine{"L5", 29, 0.560, 1927.2, 1.47, 113},
    TableLine{"L6", 9, -1.640, 1646.1, 3.05, 50}};

/// Noise of the ranges that gives mean errors as in the table.
inline constexpr double kTable1Sigma_m = 0.002;

/// Normal form of a row: r in m, alpha in rad.
[[nodiscard]] double true_r_m(const TableLine& line);
[[nodiscard]] double true_alpha_rad(const TableLine& line);

/// Bearing of beam 0 at which the last beam of L3 just misses its corner with L4, at 86.92 degrees.
inline constexpr double kTable1Bearing_deg = -0.13;
/// For any bearing of beam 0 above this, up to kTable1Bearing_deg, the beams of the table are on their lines.
inline constexpr double kTable1MinBearing_deg = -1.07;

/// 360 beams, the lines of Table 1 with Gaussian noise; no return elsewhere.
[[nodiscard]] LaserScan table1_scan(Rng& rng, double first_bearing_deg = kTable1Bearing_deg);

/// The line that holds most of a row's beams. Nothing: no line holds half of them.
[[nodiscard]] std::optional<std::size_t> find_row(const lines::ScanLines& found, const TableLine& row);

/// Mean distance of a line's points from it: E_k / P of Table 1.
[[nodiscard]] double mean_error_m(const LaserScan& scan, const lines::ScanLines& found, std::size_t line);

}  // namespace seeker::lab
