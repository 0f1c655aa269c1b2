/// \file
/// Tables over runs: one row for each world and strategy, with its seeds.
#pragma once

#include <string>
#include <vector>

#include "common/core/image.hpp"
#include "server/lab/search/run_result.hpp"

namespace seeker::lab {

/// The runs of one strategy in one world together. Values are means over the runs, unless stated otherwise.
struct GroupSummary {
  std::string world;
  std::string strategy;
  std::string seeds;  ///< "1-20"
  int runs = 0;
  int found = 0;
  int false_finds = 0;  ///< sum over the runs
  double path_length_m = 0.0;
  double target_path_m = 0.0;  ///< mean over the runs that found it
  double robot_time_s = 0.0;
  double cells_visited = 0.0;
  double cells_repeated = 0.0;
  double cells_searched = 0.0;
  double covered_share = 0.0;
  double covered_share_min = 0.0;
  double covered_true_share = 0.0;
  double mean_probability = 0.0;
  int contacts = 0;                   ///< sum over the runs
  double min_clearance_m = 0.0;       ///< smallest of all runs
  double bearing_error_deg = 0.0;     ///< largest of all first reports
  double position_error_m = 0.0;      ///< largest of all last reports
  double aligned_error_m = 0.0;       ///< largest of all searches that map the building too
  double localisation_error_m = 0.0;  ///< largest at any time
  double speed = 0.0;                 ///< robot seconds per wall second, of all runs together
};

/// In the order in which the groups first occur.
[[nodiscard]] std::vector<GroupSummary> summarise(const std::vector<RunResult>& results);

/// Tables with a header line. Numbers are printed with their significant digits.
[[nodiscard]] std::string runs_csv(const std::vector<RunResult>& results);
[[nodiscard]] std::string summary_csv(const std::vector<GroupSummary>& groups);
/// The table for people, with aligned columns.
[[nodiscard]] std::string summary_text(const std::vector<GroupSummary>& groups);
[[nodiscard]] std::string summary_json(const std::vector<GroupSummary>& groups);

/// Bars for each strategy of each world: share found, path to the target, floor covered, repeated cells.
[[nodiscard]] Image comparison_chart(const std::vector<GroupSummary>& groups);

}  // namespace seeker::lab
