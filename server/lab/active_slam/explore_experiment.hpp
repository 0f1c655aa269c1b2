/// \file
/// Runs many explorations and makes tables of them. Each run leaves numbers, curves, a log and a picture, and only runs
/// without these files are made.
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

/// The results in the order of `specs`. Errors: those of resume_runs().
[[nodiscard]] Result<std::vector<ExploreResult>> explore_missing(const std::vector<ExploreSpec>& specs,
                                                                 const std::filesystem::path& out, int jobs,
                                                                 bool show_progress);

/// Loads the curves of the finished runs of one seed, each named by its strategy. Errors: kNotFound, kParse.
[[nodiscard]] Result<std::vector<NamedCurve>> curves_of_seed(const std::vector<ExploreSpec>& specs, std::uint64_t seed,
                                                             const std::filesystem::path& out);

/// The mean of several runs and their spread around it.
struct MeanSpread {
  double mean = 0.0;
  double sigma = 0.0;  ///< standard deviation of the sample; 0 for one run
};
[[nodiscard]] MeanSpread mean_spread(const std::vector<double>& values);

/// Table with one row for each run.
[[nodiscard]] Table explore_runs_table(const std::vector<ExploreResult>& results);
/// JSON list of the results.
[[nodiscard]] std::string explore_json(const std::vector<ExploreResult>& results);
/// Table with one row for each world and strategy, in the order in which they first occur: means and spreads, sums of
/// contacts.
[[nodiscard]] Table explore_summary_table(const std::vector<ExploreResult>& results);
/// Writes table.csv and table.md. Error: kIo.
[[nodiscard]] Status write_table(const std::filesystem::path& out, const Table& table);
/// Writes table.csv and table.md with the summary, and runs.csv with the results. Error: kIo.
[[nodiscard]] Status write_explore_tables(const std::filesystem::path& out, const Table& summary,
                                          const std::vector<ExploreResult>& results);

}  // namespace seeker::lab
