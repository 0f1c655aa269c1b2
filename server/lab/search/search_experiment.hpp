/// \file
/// Many runs: each leaves a file, and only those without one are made.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "server/lab/search/search_run.hpp"

namespace seeker::lab {

struct ExperimentParams {
  std::filesystem::path out;  ///< runs go to out/runs/WORLD/STRATEGY/seed-N.json
  int jobs = 1;               ///< whole robots in so many threads
  bool pictures = false;      ///< beside every new run a picture of its map
  bool show_progress = false;
};

/// Where a run's numbers are kept.
[[nodiscard]] std::filesystem::path run_file(const std::filesystem::path& out, const RunSpec& spec);

/// The results of all runs, in the order of `specs`: read where a file with the same settings is there, made where not.
/// A run that cannot be made does not stop the others; then the error names the first of them.
[[nodiscard]] Result<std::vector<RunResult>> run_missing(const std::vector<RunSpec>& specs,
                                                         const ExperimentParams& params);

/// Called with every record of a new run, from the thread that made it.
using RecordSink = std::function<Status(const RunSpec&, const RunRecord&)>;
[[nodiscard]] Result<std::vector<RunResult>> run_missing(const std::vector<RunSpec>& specs,
                                                         const ExperimentParams& params, const RecordSink& sink);

/// A world file beside `world_file`'s content without its targets, written into `folder`; its path.
[[nodiscard]] Result<std::filesystem::path> without_targets(const std::filesystem::path& world_file,
                                                            const std::filesystem::path& folder);

}  // namespace seeker::lab
