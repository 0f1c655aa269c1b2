/// \file
/// Runs many searches: each leaves a file, and only those without a file are made.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "server/lab/search/search_run.hpp"

namespace seeker::lab {

struct ExperimentParams {
  std::filesystem::path out;  ///< runs go to out/runs/WORLD/STRATEGY/seed-N.json
  int jobs = 1;               ///< number of threads, each with whole robots
  bool pictures = false;      ///< true: a picture of the map for every new run
  bool show_progress = false;
};

/// The file of a run's numbers.
[[nodiscard]] std::filesystem::path run_file(const std::filesystem::path& out, const RunSpec& spec);

/// The results of all runs, in the order of `specs`: read where a file with the same settings exists, otherwise made. A
/// run that cannot be made does not stop the others; the error then names the first of them.
[[nodiscard]] Result<std::vector<RunResult>> run_missing(const std::vector<RunSpec>& specs,
                                                         const ExperimentParams& params);

/// Called with the record of every new run, from the thread that made it.
using RecordSink = std::function<Status(const RunSpec&, const RunRecord&)>;
[[nodiscard]] Result<std::vector<RunResult>> run_missing(const std::vector<RunSpec>& specs,
                                                         const ExperimentParams& params, const RecordSink& sink);

/// Writes a copy of `world_file` without its targets into `folder` and returns its path.
[[nodiscard]] Result<std::filesystem::path> without_targets(const std::filesystem::path& world_file,
                                                            const std::filesystem::path& folder);

}  // namespace seeker::lab
