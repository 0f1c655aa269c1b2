#include <algorithm>
#include <array>
#include <cmath>

#include "common/config/yaml.hpp"
#include "common/core/angle.hpp"
#include "server/lab/experiments/seeds.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/search/reproduce_search.hpp"
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

void check_bearings(Report& report) {
  constexpr double kLimit_deg = 0.05;
  const vision::OmniCamera camera;
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
  constexpr std::size_t kRules = 160;
  report.add({.id = "R7",
              .passed = rules.size() == kRules && counts == kRuleCounts && file_agrees,
              .figures = {{"rules", std::to_string(rules.size())},
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
  check.figures = {{"layout", runs.empty() ? "none" : runs.front().world},
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

}  // namespace seeker::lab
