/// \file
/// seeker-lab score and trajectory: files in, figures out.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>

#include "common/core/result.hpp"
#include "server/lab/scoring/score_relations.hpp"

namespace seeker::lab {

struct ScoreOptions {
  std::filesystem::path trajectory;
  std::filesystem::path relations;    ///< either these,
  std::filesystem::path reference;    ///< or poses of the base,
  std::filesystem::path corrections;  ///< or a localiser's poses of the odometry's frame, which need `odometry`
  std::filesystem::path odometry;     ///< log whose odometry carries poses between scans; empty: interpolated
  RelationParams params;
  bool exact_only = false;  ///< print only the subset between exactly stamped scans
  bool json = false;
};

/// Prints figures to `out` and what was skipped in the files to `notes`. Errors of the files, and kInvalidArgument
/// where options or clocks do not go together.
[[nodiscard]] Status run_score(const ScoreOptions& options, std::ostream& out, std::ostream& notes);

/// Which poses of a log `trajectory` writes.
enum class LogPoseSource : std::uint8_t { kOdometry, kCorrected };

/// Writes the log's poses as a TUM file. kNotReady where the log has none of the kind.
[[nodiscard]] Status write_log_trajectory(const std::filesystem::path& log, LogPoseSource source,
                                          const std::filesystem::path& out, std::ostream& notes);

}  // namespace seeker::lab
