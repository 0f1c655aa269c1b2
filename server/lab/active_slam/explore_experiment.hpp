/// \file
/// Many explorations: each leaves numbers, curves, log and a picture, and only those without are made; tables of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/lab/active_slam/explore_run.hpp"
#include "server/lab/experiments/table.hpp"

namespace seeker::lab {

/// out/runs/WORLD/STRATEGY/seed-N with an extension: .json numbers, .csv curves, .log events, .png picture.
[[nodiscard]] std::filesystem::path explore_file(const std::filesystem::path& out, const ExploreSpec& spec,
                                                 const std::string& extension);

/// The results in the order of `specs`. Errors as of resume_runs().
[[nodiscard]] Result<std::vector<ExploreResult>> explore_missing(const std::vector<ExploreSpec>& specs,
                                                                 const std::filesystem::path& out, int jobs,
                                                                 bool show_progress);

/// The curves of a run that was made. Errors: kNotFound, kParse.
[[nodiscard]] Result<std::vector<ExploreSample>> load_curves(const std::filesystem::path& out, const ExploreSpec& spec);

/// A mean and what the runs spread around it.
struct MeanSpread {
  double mean = 0.0;
  double sigma = 0.0;  ///< of the sample; 0 for one run
};
[[nodiscard]] MeanSpread mean_spread(const std::vector<double>& values);

/// A row per run.
[[nodiscard]] Table explore_runs_table(const std::vector<ExploreResult>& results);
/// A list of them.
[[nodiscard]] std::string explore_json(const std::vector<ExploreResult>& results);
/// A row per world and strategy, in the order in which they first occur: means and spreads, sums of contacts.
[[nodiscard]] Table explore_summary_table(const std::vector<ExploreResult>& results);

}  // namespace seeker::lab
