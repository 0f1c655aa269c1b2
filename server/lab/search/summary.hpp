/// \file
/// Tables over runs: one row per world and strategy, with the seeds it rests on.
#pragma once

#include <string>
#include <vector>

#include "common/core/image.hpp"
#include "server/lab/search/run_result.hpp"

namespace seeker::lab {

/// The runs of one strategy in one world together. Means are over the runs, where not said otherwise.
struct GroupSummary {
  std::string world;
  std::string strategy;
  std::string seeds;  ///< "1-20"
  int runs = 0;
  int found = 0;
  int false_finds = 0;  ///< sum
  double path_length_m = 0.0;
  double target_path_m = 0.0;  ///< over the runs that found it
  double robot_time_s = 0.0;
  double cells_visited = 0.0;
  double cells_repeated = 0.0;
  double cells_searched = 0.0;
  double covered_share = 0.0;
  double covered_share_min = 0.0;
  double covered_true_share = 0.0;
  double mean_probability = 0.0;
  int contacts = 0;                   ///< sum
  double min_clearance_m = 0.0;       ///< smallest
  double bearing_error_deg = 0.0;     ///< largest, first reports
  double position_error_m = 0.0;      ///< largest, last reports
  double aligned_error_m = 0.0;       ///< largest, of searches that map the building too
  double localisation_error_m = 0.0;  ///< largest at any time
  double speed = 0.0;                 ///< robot seconds per wall second, of all runs together
};

/// In the order in which the groups first occur.
[[nodiscard]] std::vector<GroupSummary> summarise(const std::vector<RunResult>& results);

/// Tables with a header line. Numbers are printed with the digits that mean something.
[[nodiscard]] std::string runs_csv(const std::vector<RunResult>& results);
[[nodiscard]] std::string summary_csv(const std::vector<GroupSummary>& groups);
/// For people: aligned columns.
[[nodiscard]] std::string summary_text(const std::vector<GroupSummary>& groups);
[[nodiscard]] std::string summary_json(const std::vector<GroupSummary>& groups);

/// Bars per strategy of each world: share found, path to the target, floor covered, repeated cells.
[[nodiscard]] Image comparison_chart(const std::vector<GroupSummary>& groups);

}  // namespace seeker::lab
