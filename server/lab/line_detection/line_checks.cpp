#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/line_detection/line_scene.hpp"
#include "server/lab/line_detection/reproduce_line_detection.hpp"
#include "server/lines/polar_fit.hpp"
#include "server/lines/split_extractors.hpp"

namespace seeker::lab {
namespace {

constexpr double kAlphaLimit_deg = 0.5;
constexpr double kRLimit_mm = 5.0;
constexpr double kMeanErrorLimit_mm = 5.0;
constexpr double kSigmas = 3.0;
/// Of Gaussian errors 0.3 % are beyond 3 sigma.
constexpr double kMaxOutsideShare = 0.01;
constexpr double kMillimetres = 1000.0;
constexpr double kChange_mm = 1.0;
constexpr double kChange_deg = 0.1;

/// L3 and L6 have 9 points only: their direction is not known to half a degree.
bool is_short(const TableLine& row) { return row.points < 10; }

struct RowError {
  double r_mm = 0.0;
  double alpha_deg = 0.0;
};

RowError error_of(const lines::Line& line, const TableLine& row) {
  return {kMillimetres * std::abs(line.r_m - true_r_m(row)),
          rad_to_deg(std::abs(wrap_angle(line.alpha_rad - true_alpha_rad(row))))};
}

/// What the seeds add up to.
struct Tally {
  int scans = 0;
  int complete = 0;  ///< five lines, each on a row of its own
  RowError worst_long;
  double worst_mean_error_mm = 0.0;
  int short_values = 0;
  int short_outside = 0;
  double worst_sigmas = 0.0;
  int apart = 0;  ///< L3 and L6 are two lines
  int alike = 0;  ///< though eq (12) alone would have merged them
};

void add_row(const LaserScan& scan, const lines::ScanLines& found, const TableLine& row, std::size_t index,
             Tally& tally) {
  const lines::Line& line = found.lines[index];
  const RowError error = error_of(line, row);
  tally.worst_mean_error_mm = std::max(tally.worst_mean_error_mm, kMillimetres * mean_error_m(scan, found, index));
  if (!is_short(row)) {
    tally.worst_long.r_mm = std::max(tally.worst_long.r_mm, error.r_mm);
    tally.worst_long.alpha_deg = std::max(tally.worst_long.alpha_deg, error.alpha_deg);
    return;
  }
  const std::array sigmas{error.r_mm / kMillimetres / std::sqrt(line.covariance(0, 0)),
                          deg_to_rad(error.alpha_deg) / std::sqrt(line.covariance(1, 1))};
  for (const double value : sigmas) {
    ++tally.short_values;
    tally.short_outside += value > kSigmas ? 1 : 0;
    tally.worst_sigmas = std::max(tally.worst_sigmas, value);
  }
}

void add_scan(const LaserScan& scan, Tally& tally) {
  const lines::PaperParams params = printed_line_params();
  const lines::ScanLines found = lines::PaperExtractor(params).extract(scan);
  std::vector<std::size_t> indices;
  for (const TableLine& row : kTable1) {
    if (const std::optional<std::size_t> index = find_row(found, row)) {
      add_row(scan, found, row, *index, tally);
      indices.push_back(*index);
    }
  }
  ++tally.scans;
  std::sort(indices.begin(), indices.end());
  const bool distinct = std::adjacent_find(indices.begin(), indices.end()) == indices.end();
  tally.complete += distinct && indices.size() == kTable1.size() && found.lines.size() == kTable1.size() ? 1 : 0;
  const auto l3 = find_row(found, kTable1[1]);
  const auto l6 = find_row(found, kTable1[4]);
  if (l3 && l6 && *l3 != *l6) {
    ++tally.apart;
    tally.alike += lines::mahalanobis_distance(found.lines[*l3], found.lines[*l6]) < params.merge_distance ? 1 : 0;
  }
}

/// Largest change of any line against the thresholds as printed.
struct Sensitivity {
  bool complete = true;  ///< five lines always
  int scans = 0;
  int changed = 0;  ///< scans with a line that moved by more than kChange_mm or kChange_deg
  RowError worst;
};

template <class Extract>
void add_change(const lines::ScanLines& reference, const Extract& extract, Sensitivity& sensitivity) {
  const lines::ScanLines found = extract();
  sensitivity.complete = sensitivity.complete && found.lines.size() == kTable1.size();
  RowError change;
  for (const TableLine& row : kTable1) {
    const auto a = find_row(reference, row);
    const auto b = find_row(found, row);
    if (!a || !b) {
      sensitivity.complete = false;
      continue;
    }
    const lines::Line& p = reference.lines[*a];
    const lines::Line& q = found.lines[*b];
    change.r_mm = std::max(change.r_mm, kMillimetres * std::abs(p.r_m - q.r_m));
    change.alpha_deg = std::max(change.alpha_deg, rad_to_deg(std::abs(wrap_angle(p.alpha_rad - q.alpha_rad))));
  }
  ++sensitivity.scans;
  sensitivity.changed += change.r_mm > kChange_mm || change.alpha_deg > kChange_deg ? 1 : 0;
  sensitivity.worst.r_mm = std::max(sensitivity.worst.r_mm, change.r_mm);
  sensitivity.worst.alpha_deg = std::max(sensitivity.worst.alpha_deg, change.alpha_deg);
}

void join(Sensitivity& all, const Sensitivity& one) {
  all.complete = all.complete && one.complete;
  all.scans += one.scans;
  all.changed += one.changed;
  all.worst.r_mm = std::max(all.worst.r_mm, one.worst.r_mm);
  all.worst.alpha_deg = std::max(all.worst.alpha_deg, one.worst.alpha_deg);
}

lines::PaperParams scaled_paper(double scale) {
  lines::PaperParams params = printed_line_params();
  params.start = {scale * params.start.gap_m, scale * params.start.corner_m};
  return params;
}

lines::SplitParams scaled_split(double scale) {
  lines::SplitParams params;
  params.noise.sigma_m = kTable1Sigma_m;
  params.gap_m *= scale;
  params.split_m *= scale;
  return params;
}

/// Both detectors on one scan, thresholds scaled against thresholds as printed.
struct Comparison {
  Sensitivity paper;
  Sensitivity split;
};

void compare(const LaserScan& scan, double scale, Comparison& comparison) {
  const auto by_paper = [&](double s) { return lines::PaperExtractor(scaled_paper(s)).extract(scan); };
  const auto by_split = [&](double s) { return lines::SplitAndMerge(scaled_split(s)).extract(scan); };
  add_change(
      by_paper(1.0), [&] { return by_paper(scale); }, comparison.paper);
  add_change(
      by_split(1.0), [&] { return by_split(scale); }, comparison.split);
}

constexpr std::array kScales{0.5, 0.7, 0.85, 1.0, 1.2, 1.4, 2.0};

/// All scales; a row of the table each. `wander`: the corner between L3 and L4 lies anywhere between two beams.
Comparison compare_scales(const std::vector<std::uint64_t>& seeds, bool wander, Table& table) {
  Comparison all;
  for (const double scale : kScales) {
    Comparison one;
    for (const std::uint64_t seed : seeds) {
      Rng rng(seed);
      const double bearing_deg = wander ? rng.uniform(kTable1MinBearing_deg, kTable1Bearing_deg) : kTable1Bearing_deg;
      compare(table1_scan(rng, bearing_deg), scale, one);
    }
    table.add({wander ? "anywhere" : "as in Table 1", fixed(scale, 2), std::to_string(one.paper.scans),
               std::to_string(one.paper.changed), fixed(one.paper.worst.r_mm, 2), fixed(one.paper.worst.alpha_deg, 3),
               std::to_string(one.split.changed), fixed(one.split.worst.r_mm, 2), fixed(one.split.worst.alpha_deg, 3)});
    join(all.paper, one.paper);
    join(all.split, one.split);
  }
  return all;
}

std::string share(int part, int whole) { return std::to_string(part) + "/" + std::to_string(whole); }

}  // namespace

void check_table1(const std::vector<std::uint64_t>& seeds, Report& report) {
  Tally tally;
  for (const std::uint64_t seed : seeds) {
    Rng rng(seed);
    add_scan(table1_scan(rng), tally);
  }
  report.add({.id = "R10",
              .passed = tally.complete == tally.scans,
              .figures = {{"lines", "5"}, {"complete", share(tally.complete, tally.scans)}}});
  report.add({.id = "R10",
              .passed = tally.worst_long.alpha_deg <= kAlphaLimit_deg && tally.worst_long.r_mm <= kRLimit_mm,
              .figures = {{"lines", "L1,L4,L5"},
                          {"alpha_deg", fixed(tally.worst_long.alpha_deg, 3)},
                          {"alpha_limit", fixed(kAlphaLimit_deg, 1)},
                          {"r_mm", fixed(tally.worst_long.r_mm, 2)},
                          {"r_limit", fixed(kRLimit_mm, 0)}}});
  report.add({.id = "R10",
              .passed = tally.short_outside <= kMaxOutsideShare * tally.short_values,
              .figures = {{"lines", "L3,L6"},
                          {"outside_3_sigma", share(tally.short_outside, tally.short_values)},
                          {"limit", fixed(kMaxOutsideShare, 2)},
                          {"worst_sigmas", fixed(tally.worst_sigmas, 2)}}});
  report.add(
      {.id = "R10",
       .passed = tally.worst_mean_error_mm < kMeanErrorLimit_mm,
       .figures = {{"mean_error_mm", fixed(tally.worst_mean_error_mm, 2)}, {"limit", fixed(kMeanErrorLimit_mm, 0)}}});
  report.add({.id = "R10",
              .passed = tally.apart == tally.scans,
              .figures = {{"L3_L6_apart", share(tally.apart, tally.scans)},
                          {"alike_but_for_their_ends", share(tally.alike, tally.scans)}}});
}

std::string check_thresholds(const std::vector<std::uint64_t>& seeds, Report& report) {
  Table table({"corner", "scale", "scans", "paper_changed", "paper_r_mm", "paper_alpha_deg", "split_changed",
               "split_r_mm", "split_alpha_deg"});
  for (const bool wander : {false, true}) {
    const Comparison all = compare_scales(seeds, wander, table);
    const bool steady = wander ? all.paper.changed < all.split.changed : all.paper.changed == 0;
    report.add({.id = "R10",
                .passed = all.paper.complete && steady,
                .figures = {{"thresholds", "x0.5..x2"},
                            {"corner", wander ? "anywhere" : "as_in_table_1"},
                            {"paper_changed", share(all.paper.changed, all.paper.scans)},
                            {"paper_alpha_deg", fixed(all.paper.worst.alpha_deg, 2)},
                            {"split_and_merge_changed", share(all.split.changed, all.split.scans)},
                            {"split_and_merge_alpha_deg", fixed(all.split.worst.alpha_deg, 2)}}});
  }
  return table.csv();
}

}  // namespace seeker::lab
