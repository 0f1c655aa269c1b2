#include "server/lab/line_detection/line_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/core/angle.hpp"

namespace seeker::lab {
namespace {

constexpr int kBeams = 360;
constexpr double kRangeMax_m = 6.0;

/// y = kappa x + b as kappa x - y + b = 0.
double norm_of(const TableLine& line) { return std::hypot(line.slope, 1.0); }

}  // namespace

double true_r_m(const TableLine& line) { return std::abs(line.intercept_mm) / norm_of(line) / 1000.0; }

double true_alpha_rad(const TableLine& line) {
  const double sign = line.intercept_mm > 0.0 ? 1.0 : -1.0;
  return std::atan2(sign, -sign * line.slope);
}

LaserScan table1_scan(Rng& rng, double first_bearing_deg) {
  LaserScan scan;
  scan.angle_min_rad = deg_to_rad(first_bearing_deg);
  scan.angle_step_rad = kTwoPi / kBeams;
  scan.range_max_m = kRangeMax_m;
  scan.ranges_m.assign(kBeams, kNoReturn);
  for (const TableLine& line : kTable1) {
    for (int k = 0; k < line.points; ++k) {
      const auto beam = static_cast<std::size_t>(line.first_beam + k);
      const double range_m = true_r_m(line) / std::cos(scan.angle_rad(beam) - true_alpha_rad(line));
      scan.ranges_m[beam] = static_cast<float>(range_m + rng.normal(kTable1Sigma_m));
    }
  }
  return scan;
}

std::optional<std::size_t> find_row(const lines::ScanLines& found, const TableLine& row) {
  std::map<std::int32_t, int> votes;
  for (int k = 0; k < row.points; ++k) {
    ++votes[found.line_of_beam[static_cast<std::size_t>(row.first_beam + k)]];
  }
  for (const auto& [line, beams] : votes) {
    if (line != lines::kNoLine && 2 * beams > row.points) {
      return static_cast<std::size_t>(line);
    }
  }
  return std::nullopt;
}

double mean_error_m(const LaserScan& scan, const lines::ScanLines& found, std::size_t line) {
  const lines::Line& l = found.lines[line];
  double sum = 0.0;
  int count = 0;
  for (std::size_t beam = 0; beam < found.line_of_beam.size(); ++beam) {
    if (found.line_of_beam[beam] == static_cast<std::int32_t>(line)) {
      const double range_m = static_cast<double>(scan.ranges_m[beam]);
      sum += std::abs(range_m * std::cos(scan.angle_rad(beam) - l.alpha_rad) - l.r_m);
      ++count;
    }
  }
  return sum / std::max(count, 1);
}

}  // namespace seeker::lab
