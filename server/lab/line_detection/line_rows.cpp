#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/line_detection/line_scene.hpp"
#include "server/lab/line_detection/reproduce_line_detection.hpp"

namespace seeker::lab {
namespace {

constexpr double kRowAlpha_deg = 0.5;
constexpr double kRowR_mm = 5.0;
constexpr double kRowError_mm = 5.0;

/// Means over the seeds.
struct RowMean {
  int found = 0;
  double points = 0.0;
  double alpha_error_deg = 0.0;
  double r_error_mm = 0.0;
  double slope = 0.0;
  double intercept_mm = 0.0;
  double error_mm = 0.0;
};

RowMean mean_of(const TableLine& row, const std::vector<std::uint64_t>& seeds) {
  RowMean sum;
  for (const std::uint64_t seed : seeds) {
    Rng rng(seed);
    const LaserScan scan = table1_scan(rng);
    const lines::ScanLines found = lines::PaperExtractor(printed_line_params()).extract(scan);
    const std::optional<std::size_t> index = find_row(found, row);
    if (!index) {
      continue;
    }
    const lines::Line& line = found.lines[*index];
    ++sum.found;
    sum.points += line.points;
    sum.alpha_error_deg += rad_to_deg(wrap_angle(line.alpha_rad - true_alpha_rad(row)));
    sum.r_error_mm += 1e3 * (line.r_m - true_r_m(row));
    sum.slope += line.slope.value_or(0.0);
    sum.intercept_mm += 1e3 * line.intercept_m.value_or(0.0);
    sum.error_mm += 1e3 * mean_error_m(scan, found, *index);
  }
  const double n = std::max(sum.found, 1);
  return {sum.found,     sum.points / n,       sum.alpha_error_deg / n, sum.r_error_mm / n,
          sum.slope / n, sum.intercept_mm / n, sum.error_mm / n};
}

}  // namespace

void check_rows(const std::vector<std::uint64_t>& seeds, Report& report) {
  for (const TableLine& row : kTable1) {
    const RowMean ours = mean_of(row, seeds);
    const double alpha_deg = rad_to_deg(true_alpha_rad(row));
    const double r_mm = 1e3 * true_r_m(row);
    const bool close = std::abs(ours.alpha_error_deg) <= kRowAlpha_deg && std::abs(ours.r_error_mm) <= kRowR_mm;
    report.add({.id = "Table1",
                .passed = ours.found == static_cast<int>(seeds.size()) && close && ours.error_mm < kRowError_mm,
                .figures = {{"line", row.name},
                            {"P_printed", std::to_string(row.points)},
                            {"P_ours", fixed(ours.points, 1)},
                            {"kappa_printed", fixed(row.slope, 3)},
                            {"kappa_ours", fixed(ours.slope, 3)},
                            {"b_mm_printed", fixed(row.intercept_mm, 1)},
                            {"b_mm_ours", fixed(ours.intercept_mm, 1)},
                            {"error_mm_printed", fixed(row.printed_mean_error_mm, 2)},
                            {"error_mm_ours", fixed(ours.error_mm, 2)},
                            {"r_mm_printed", fixed(r_mm, 1)},
                            {"r_mm_ours", fixed(r_mm + ours.r_error_mm, 1)},
                            {"alpha_deg_printed", fixed(alpha_deg, 2)},
                            {"alpha_deg_ours", fixed(alpha_deg + ours.alpha_error_deg, 2)}}});
  }
}

}  // namespace seeker::lab
