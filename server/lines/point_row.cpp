#include "server/lines/point_row.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/lines/scan_circle.hpp"

namespace seeker::lines {
namespace {

bool is_usable(const LaserScan& scan, const RangeLimits& limits, std::size_t beam) {
  const double range = static_cast<double>(scan.ranges_m[beam]);
  const double scanner_m = scan.range_max_m > 0.0 ? scan.range_max_m : std::numeric_limits<float>::max();
  const double max_m = limits.max_m > 0.0 ? std::min(limits.max_m, scanner_m) : scanner_m;
  return range >= std::max(scan.range_min_m, limits.min_m) && range <= max_m &&
         (scan.quality.empty() || scan.quality[beam] > 0);
}

RangeNoise noise_of(const LaserScan& scan, const PointRow& row, const NoiseParams& params) {
  std::vector<float> ranges;
  std::vector<std::int32_t> ranks;
  for (const std::size_t beam : row.beams) {
    ranges.push_back(scan.ranges_m[beam]);
    const std::size_t rank = scan.angle_step_rad < 0.0 ? scan.ranges_m.size() - 1 - beam : beam;
    ranks.push_back(static_cast<std::int32_t>(rank));
  }
  NoiseEstimator estimator;
  std::vector<float> squares;
  const std::int32_t circle = circle_of(scan).even ? static_cast<std::int32_t>(scan.ranges_m.size()) : 0;
  estimator.differences(ranges, ranks, scan.angle_step_rad, circle, squares);
  return estimator.estimate(ranges, squares, params);
}

/// Where to open the circle: behind the widest gap between neighbours.
std::size_t widest_gap(const PointRow& row) {
  const std::size_t n = row.size();
  std::size_t widest = 0;
  double width = (row.points.front() - row.points.back()).norm();
  for (std::size_t i = 1; i < n; ++i) {
    if (row.gap_m(i) > width) {
      width = row.gap_m(i);
      widest = i;
    }
  }
  return widest;
}

double end_gap_m(const Line& a, const Line& b) {
  return std::min(
      {(a.start - b.start).norm(), (a.start - b.end).norm(), (a.end - b.start).norm(), (a.end - b.end).norm()});
}

}  // namespace

PointRow point_row(const LaserScan& scan, const NoiseParams& noise, const RangeLimits& limits) {
  PointRow row;
  const std::size_t n = scan.ranges_m.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t beam = scan.angle_step_rad < 0.0 ? n - 1 - k : k;
    if (is_usable(scan, limits, beam)) {
      row.beams.push_back(beam);
      row.polar.push_back({.range_m = static_cast<double>(scan.ranges_m[beam]),
                           .angle_rad = scan.angle_rad(beam),
                           .weight = scan.quality.empty() ? 1.0 : static_cast<double>(scan.quality[beam])});
      row.points.push_back(row.polar.back().cartesian());
      row.mean_range_m += row.polar.back().range_m;
    }
  }
  row.mean_range_m /= std::max(1.0, static_cast<double>(row.size()));
  row.noise = noise_of(scan, row, noise);
  for (PolarPoint& p : row.polar) {
    p.sigma_m = row.noise.sigma_m(p.range_m);
  }
  if (row.size() > 1 && circle_of(scan).closed) {
    const auto shift = static_cast<std::ptrdiff_t>(widest_gap(row));
    std::rotate(row.beams.begin(), row.beams.begin() + shift, row.beams.end());
    std::rotate(row.polar.begin(), row.polar.begin() + shift, row.polar.end());
    std::rotate(row.points.begin(), row.points.begin() + shift, row.points.end());
  }
  return row;
}

LineFit fit_points(const PointRow& row, const Indices& indices) {
  Moments sums;
  for (const std::size_t i : indices) {
    sums.add(row.points[i].x(), row.points[i].y(), row.polar[i].weight);
  }
  return fit_line(sums);
}

Line build_line(const LaserScan& scan, const PointRow& row, const Indices& indices, double bearing_sigma_rad) {
  std::vector<PolarPoint> polar;
  polar.reserve(indices.size());
  for (const std::size_t i : indices) {
    polar.push_back(row.polar[i]);
  }
  const LineFit fit = fit_line(moments_of(polar));
  Line line;
  describe_line(fit, row.points[indices.front()], row.points[indices.back()], line);
  line.covariance = polar_covariance(polar, fit, bearing_sigma_rad);
  line.first_beam = row.beams[indices.front()];
  line.last_beam = row.beams[indices.back()];
  line.start_rad = scan.angle_rad(line.first_beam);
  line.end_rad = scan.angle_rad(line.last_beam);
  line.points = static_cast<int>(indices.size());
  return line;
}

ScanLines build_lines(const LaserScan& scan, const PointRow& row, std::vector<Indices> lines,
                      double bearing_sigma_rad) {
  const auto start_rad = [&](const Indices& line) { return row.polar[line.front()].angle_rad; };
  std::sort(lines.begin(), lines.end(),
            [&](const Indices& a, const Indices& b) { return start_rad(a) < start_rad(b); });
  ScanLines found;
  found.noise = row.noise;
  found.range_sigma_m = row.noise.sigma_m(row.mean_range_m);
  found.line_of_beam.assign(scan.ranges_m.size(), kNoLine);
  for (const Indices& line : lines) {
    for (const std::size_t i : line) {
      // A corner belongs to both its lines: it is named after the first.
      std::int32_t& owner = found.line_of_beam[row.beams[i]];
      owner = owner == kNoLine ? static_cast<std::int32_t>(found.lines.size()) : owner;
    }
    found.lines.push_back(build_line(scan, row, line, bearing_sigma_rad));
  }
  return found;
}

std::vector<Indices> merge_lines(const LaserScan& scan, const PointRow& row, std::vector<Indices> lines,
                                 double max_distance, double max_gap_m, double bearing_sigma_rad) {
  std::vector<Line> fits;
  fits.reserve(lines.size());
  for (const Indices& line : lines) {
    fits.push_back(build_line(scan, row, line, bearing_sigma_rad));
  }
  for (std::size_t a = 0; a < lines.size(); ++a) {
    for (std::size_t b = a + 1; b < lines.size(); ++b) {
      if (end_gap_m(fits[a], fits[b]) > max_gap_m || mahalanobis_distance(fits[a], fits[b]) >= max_distance) {
        continue;
      }
      Indices both;
      std::set_union(lines[a].begin(), lines[a].end(), lines[b].begin(), lines[b].end(), std::back_inserter(both));
      lines[a] = std::move(both);
      fits[a] = build_line(scan, row, lines[a], bearing_sigma_rad);
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(b));
      fits.erase(fits.begin() + static_cast<std::ptrdiff_t>(b));
      // The longer line may take in what the shorter one did not.
      a = 0;
      b = 0;
    }
  }
  return lines;
}

}  // namespace seeker::lines
