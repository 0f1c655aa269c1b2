#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "common/config/yaml.hpp"
#include "common/core/angle.hpp"
#include "server/lab/experiments/seeds.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/search/reproduce_search.hpp"
#include "server/search/fuzzy_planner.hpp"
#include "server/search/fuzzy_rules.hpp"
#include "server/vision/omni_camera.hpp"

namespace seeker::lab {
namespace {

/// A line of spec S3.6: the pixel of the target, its bearing as printed, the robot's heading, the result.
struct PrintedCase {
  const char* layout;
  vision::PixelPoint pixel;
  double bearing_deg;          ///< alpha' with the digit that the paper rounds away
  double printed_bearing_deg;  ///< alpha'
  double heading_deg;          ///< theta_r
  double result_deg;           ///< theta_0
};

constexpr std::array kPrinted{PrintedCase{"a", {123.0, 276.0}, 100.6, 100.0, -41.0, 59.0},
                              PrintedCase{"b", {117.0, 263.0}, 96.6, 97.0, -39.0, 58.0}};

/// Counts of spec S3.2 for TNB, TNS, TZ, TPS, TPB.
constexpr std::array<int, search::kLevels> kRuleCounts{23, 42, 20, 46, 29};

}  // namespace

void check_bearings(Report& report, const vision::OmniCameraParams& params) {
  constexpr double kLimit_deg = 0.05;
  const vision::OmniCamera camera(params);
  for (const PrintedCase& printed : kPrinted) {
    const double bearing_deg = rad_to_deg(camera.bearing_base_rad(printed.pixel));
    const double sum_deg =
        rad_to_deg(wrap_angle(deg_to_rad(printed.printed_bearing_deg) + deg_to_rad(printed.heading_deg)));
    report.add({.id = "R6",
                .passed = std::abs(bearing_deg - printed.bearing_deg) <= kLimit_deg &&
                          std::lround(sum_deg) == std::lround(printed.result_deg),
                .figures = {{"layout", printed.layout},
                            {"alpha_deg", fixed(bearing_deg, 2)},
                            {"expected", fixed(printed.bearing_deg, 1)},
                            {"limit", fixed(kLimit_deg, 2)},
                            {"theta_deg", fixed(sum_deg, 0)},
                            {"printed", fixed(printed.result_deg, 0)}}});
  }
}

void check_rules(const std::filesystem::path& config, Report& report) {
  std::array<int, search::kLevels> counts{};
  const std::vector<search::FuzzyRule> rules = search::generate_rules();
  for (const search::FuzzyRule& rule : rules) {
    ++counts.at(static_cast<std::size_t>(rule.output + 2));
  }
  const Result<std::string> file = config::read_text_file(config / "fuzzy" / "planner.fll");
  const bool file_agrees = file && *file == search::generate_fll();
  const Result<search::FuzzyPlanner> planner =
      file ? search::FuzzyPlanner::create(*file) : tl::unexpected<Error>(file.error());
  constexpr std::size_t kRules = 160;
  report.add({.id = "R7",
              .passed = rules.size() == kRules && counts == kRuleCounts && file_agrees && planner &&
                        planner->rule_count() == kRules,
              .figures = {{"rules", std::to_string(rules.size())},
                          {"planner_rules", planner ? std::to_string(planner->rule_count()) : "none"},
                          {"TNB", std::to_string(counts[0])},
                          {"TNS", std::to_string(counts[1])},
                          {"TZ", std::to_string(counts[2])},
                          {"TPS", std::to_string(counts[3])},
                          {"TPB", std::to_string(counts[4])},
                          {"planner_fll", file_agrees ? "same" : "differs"}}});
}

Check check_layout(const std::vector<RunResult>& runs, int paper_cells) {
  Check check{.id = "R5", .passed = !runs.empty(), .figures = {}};
  int found = 0;
  int contacts = 0;
  double bearing_deg = 0.0;
  double position_m = 0.0;
  int cells_min = runs.empty() ? 0 : runs.front().cells_searched;
  int cells_max = 0;
  double cells_mean = 0.0;
  std::vector<std::uint64_t> seeds;
  for (const RunResult& run : runs) {
    seeds.push_back(run.seed);
    contacts += run.contacts;
    cells_min = std::min(cells_min, run.cells_searched);
    cells_max = std::max(cells_max, run.cells_searched);
    cells_mean += static_cast<double>(run.cells_searched) / static_cast<double>(runs.size());
    const bool scored = run.found && run.first_find && run.last_find && run.last_find->position_error_m;
    check.passed = check.passed && scored;
    if (scored) {
      ++found;
      bearing_deg = std::max({bearing_deg, run.first_find->bearing_error_deg, run.last_find->bearing_error_deg});
      position_m = std::max(position_m, *run.last_find->position_error_m);
    }
  }
  check.passed = check.passed && bearing_deg <= kBearingLimit_deg && position_m <= kPositionLimit_m;
  check.figures = {{"robot", "sim"},
                   {"layout", runs.empty() ? "none" : runs.front().world},
                   {"bearing_deg", fixed(bearing_deg, 1)},
                   {"limit", fixed(kBearingLimit_deg, 0)},
                   {"position_m", fixed(position_m, 2)},
                   {"position_limit", fixed(kPositionLimit_m, 1)},
                   {"found", std::to_string(found) + "/" + std::to_string(runs.size())},
                   {"cells_mean", fixed(cells_mean, 1)},
                   {"cells_range", std::to_string(cells_min) + ".." + std::to_string(cells_max)},
                   {"paper_cells", std::to_string(paper_cells)},
                   {"contacts", std::to_string(contacts)},
                   {"seeds", print_seeds(seeds)}};
  return check;
}

namespace {

/// A line of R5 about the robot as printed.
Check printed_row(const std::string& layout, const std::string& quantity, bool passed) {
  return {
      .id = "R5", .passed = passed, .figures = {{"robot", kPrintedRobot}, {"layout", layout}, {"quantity", quantity}}};
}

Check finds_row(const std::vector<RunResult>& runs, const PrintedLayout& layout, const std::string& seeds) {
  int found = 0;
  int false_finds = 0;
  int contacts = 0;
  for (const RunResult& run : runs) {
    found += run.found ? 1 : 0;
    false_finds += run.false_finds;
    contacts += run.contacts;
  }
  const int wanted = static_cast<int>(runs.size());
  Check row = printed_row(layout.world, "found", wanted > 0 && found == wanted);
  row.figures.insert(row.figures.end(), {{"printed", "1/1"},
                                         {"ours", std::to_string(found) + "/" + std::to_string(wanted)},
                                         {"false_finds", std::to_string(false_finds)},
                                         {"contacts", std::to_string(contacts)},
                                         {"seeds", seeds}});
  return row;
}

double mean_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

std::vector<Check> check_printed_robot(const std::vector<RunResult>& runs, const PrintedLayout& layout) {
  std::vector<std::uint64_t> seeds;
  std::vector<double> cells;
  std::vector<double> errors_deg;
  double heading_deg = 0.0;
  bool by_heading = true;
  for (const RunResult& run : runs) {
    seeds.push_back(run.seed);
    if (run.found && run.first_find) {
      cells.push_back(run.first_find->cells_searched);
      errors_deg.push_back(run.first_find->bearing_error_deg);
      heading_deg = std::max(heading_deg, run.localisation_error_deg);
      by_heading = by_heading && errors_deg.back() - run.localisation_error_deg <= kBearingLimit_deg;
    }
  }
  const bool any = !cells.empty();
  const auto [fewest, most] = any ? std::pair(std::ranges::min(cells), std::ranges::max(cells)) : std::pair(0.0, 0.0);
  const double worst_deg = any ? std::ranges::max(errors_deg) : 0.0;
  std::vector<Check> rows{finds_row(runs, layout, print_seeds(seeds))};
  // The paper's run is one draw in its own room: it is reproduced where it lies among ours.
  Check row = printed_row(layout.world, "cells", any && fewest <= layout.cells && layout.cells <= most);
  row.finding = any;
  row.figures.insert(row.figures.end(), {{"printed", std::to_string(layout.cells)},
                                         {"ours", fixed(mean_of(cells), 1)},
                                         {"range", fixed(fewest, 0) + ".." + fixed(most, 0)}});
  rows.push_back(std::move(row));
  row = printed_row(layout.world, "bearing_error_deg", any && worst_deg <= kBearingLimit_deg);
  row.finding = any && by_heading;  // without a laser nothing corrects the heading
  row.figures.insert(row.figures.end(), {{"printed", fixed(layout.bearing_error_deg, 0)},
                                         {"ours", fixed(mean_of(errors_deg), 1)},
                                         {"worst", fixed(worst_deg, 1)},
                                         {"limit", fixed(kBearingLimit_deg, 0)},
                                         {"heading_worst", fixed(heading_deg, 1)}});
  rows.push_back(std::move(row));
  return rows;
}

Check check_empty(const std::string& robot, const std::vector<RunResult>& runs) {
  const std::string wanted(to_string(api::Outcome::kNotFoundAreaCovered));
  std::vector<std::uint64_t> seeds;
  int ended = 0;
  int false_finds = 0;
  double covered_min = 1.0;
  double cells = 0.0;
  for (const RunResult& run : runs) {
    seeds.push_back(run.seed);
    ended += run.outcome == wanted && run.false_finds == 0 ? 1 : 0;
    false_finds += run.false_finds;
    covered_min = std::min(covered_min, run.covered_share);
    cells += static_cast<double>(run.cells_searched) / static_cast<double>(runs.size());
  }
  return {.id = "R5",
          .passed = !runs.empty() && ended == static_cast<int>(runs.size()),
          .figures = {{"robot", robot},
                      {"layout", runs.empty() ? "none" : runs.front().world},
                      {"outcome", wanted},
                      {"ended", std::to_string(ended) + "/" + std::to_string(runs.size())},
                      {"false_finds", std::to_string(false_finds)},
                      {"covered_min", fixed(covered_min, 3)},
                      {"cells_mean", fixed(cells, 1)},
                      {"seeds", print_seeds(seeds)}}};
}

}  // namespace seeker::lab
