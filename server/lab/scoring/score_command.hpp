/// \file
/// Commands `seeker-lab score` and `seeker-lab trajectory`, which read files and print figures.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>

#include "common/core/result.hpp"
#include "server/lab/scoring/score_relations.hpp"

namespace seeker::lab {

struct ScoreOptions {
  std::filesystem::path trajectory;
  std::filesystem::path relations;    ///< true relations; or
  std::filesystem::path reference;    ///< true poses of the base; or
  std::filesystem::path corrections;  ///< a localiser's poses of the odometry's frame, which need `odometry`
  std::filesystem::path odometry;  ///< log whose odometry gives the motion between scans; empty: poses are interpolated
  RelationParams params;
  bool exact_only = false;  ///< print only the subset of exactly stamped scans
  bool json = false;
};

/// Prints figures to `out` and what was skipped in the files to `notes`. Errors of the files, and kInvalidArgument
/// where options or clocks do not fit each other.
[[nodiscard]] Status run_score(const ScoreOptions& options, std::ostream& out, std::ostream& notes);

/// The poses of a log that `trajectory` writes.
enum class LogPoseSource : std::uint8_t { kOdometry, kCorrected };

/// Writes the log's poses as a TUM file. kNotReady: the log has no poses of the kind.
[[nodiscard]] Status write_log_trajectory(const std::filesystem::path& log, LogPoseSource source,
                                          const std::filesystem::path& out, std::ostream& notes);

}  // namespace seeker::lab
