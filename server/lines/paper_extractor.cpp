#include "server/lines/paper_extractor.hpp"

#include <algorithm>
#include <cmath>

#include "server/lines/five_modes.hpp"
#include "server/lines/point_row.hpp"

namespace seeker::lines {
namespace {

double fit_error_m(const PointRow& row, const Indices& line) { return std::sqrt(fit_points(row, line).mean_square_m2); }

double worst_error_m(const PointRow& row, const std::vector<Indices>& lines) {
  double worst = 0.0;
  for (const Indices& line : lines) {
    worst = std::max(worst, fit_error_m(row, line));
  }
  return worst;
}

/// Spec S5.4: both thresholds shrink until every line of the packet fits, or they are at their floors.
std::vector<Indices> extract_packet(const PointRow& row, const PaperParams& params, double spacing_rad,
                                    std::size_t first, std::size_t last, PacketHistory& history) {
  const double sigma_m = row.noise.sigma_m(row.polar[(first + last) / 2].range_m);
  const double min_corner_m = std::max(params.min_corner_m, params.corner_sigmas * sigma_m);
  ModeLimits limits{.thresholds = params.start,
                    .max_fit_error_m = std::max(params.max_fit_error_m, params.fit_error_sigmas * sigma_m),
                    .spacing_rad = params.min_gap_spacings * spacing_rad};
  limits.thresholds.corner_m = std::max(limits.thresholds.corner_m, min_corner_m);
  std::vector<Indices> lines;
  for (int round = 0; round <= params.max_rounds; ++round) {
    lines = FiveModes(row, params, limits).run(first, last);
    history.rounds.push_back(limits.thresholds);
    history.worst_error_m.push_back(worst_error_m(row, lines));
    const LineThresholds before = limits.thresholds;
    if (history.worst_error_m.back() <= limits.max_fit_error_m || before.corner_m <= min_corner_m) {
      break;
    }
    // The floor of the gap, min_gap_spacings, is kept where the gap is applied.
    limits.thresholds = {params.shrink * before.gap_m, std::max(params.shrink * before.corner_m, min_corner_m)};
  }
  return lines;
}

bool is_kept(const PointRow& row, const PaperParams& params, const Indices& line) {
  return static_cast<int>(line.size()) >= std::max(params.min_points, 2) &&
         (row.points[line.back()] - row.points[line.front()]).norm() >= std::max(params.min_length_m, 1e-3);
}

}  // namespace

ScanLines PaperExtractor::extract(const LaserScan& scan) const {
  std::vector<PacketHistory> packets;
  const PointRow row = point_row(scan, params_.noise);
  const double spacing_rad = std::abs(scan.angle_step_rad);
  std::vector<Indices> lines;
  std::size_t first = 0;
  for (std::size_t i = 1; i <= row.size(); ++i) {
    const double spacing_m = i < row.size() ? params_.min_gap_spacings * spacing_rad *
                                                  std::min(row.polar[i].range_m, row.polar[i - 1].range_m)
                                            : 0.0;
    if (i < row.size() && row.gap_m(i) <= std::max(params_.start.gap_m, spacing_m)) {
      continue;
    }
    PacketHistory history{
        .first_beam = row.beams[first], .last_beam = row.beams[i - 1], .rounds = {}, .worst_error_m = {}};
    for (Indices& line : extract_packet(row, params_, spacing_rad, first, i - 1, history)) {
      if (is_kept(row, params_, line)) {
        lines.push_back(std::move(line));
      }
    }
    packets.push_back(std::move(history));
    first = i;
  }
  lines =
      merge_lines(scan, row, std::move(lines), params_.merge_distance, params_.merge_gap_m, params_.bearing_sigma_rad);
  ScanLines found = build_lines(scan, row, std::move(lines), params_.bearing_sigma_rad);
  found.history = std::move(packets);
  return found;
}

}  // namespace seeker::lines
