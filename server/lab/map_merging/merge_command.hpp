/// \file
/// Command `seeker-lab merge`: merges the maps of recorded runs, or maps that robots saved.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "server/fleet/fleet_merge.hpp"
#include "server/fleet/joint_map.hpp"
#include "server/lab/slam/slam_run.hpp"

namespace seeker::lab {

struct MergeOptions {
  std::vector<std::filesystem::path> logs;  ///< logs, or map files (*.seekermap), which are used as they are
  std::vector<std::string> spans;  ///< one for each log, in per cent of its duration, e.g. 0-50; none: whole logs
  std::filesystem::path out;       ///< folder; empty: no file is written
  std::filesystem::path robot;     ///< robot file for all logs; empty: chosen for each log
  std::filesystem::path config;
  std::vector<std::string> overrides;
  bool json = false;
  bool show_progress = false;
};

/// One log or map, treated as a separate robot.
struct MergedLog {
  std::string name;
  SlamRun run;  ///< results of the run; for a map file, the map alone
  double prepare_s = 0.0;
};

/// Results of a merge.
struct MergeRun {
  std::vector<MergedLog> logs;  ///< by slot
  std::vector<fleet::PairAnswer> pairs;
  fleet::JointMap joint;
  double merge_s = 0.0;
  double join_s = 0.0;
};

/// Parses "0-50" in per cent. kInvalidArgument: another form, or an empty span.
[[nodiscard]] Result<LogSpan> parse_span(const std::string& text);
/// Runs line SLAM on each log, then the merger on each pair of the maps. Errors of the files and options;
/// kInvalidArgument: a span is given although one of the inputs is a map.
[[nodiscard]] Result<MergeRun> merge_logs(const MergeOptions& options);
[[nodiscard]] std::string merge_text(const MergeRun& run);
[[nodiscard]] std::string merge_json(const MergeRun& run);
/// Picture of the joined walls and the paths of the robots, in one frame.
[[nodiscard]] Result<Image> merge_picture(const MergeRun& run);
/// Runs the command, writes report.json, merged.png, merged.seekermap and for each joined log its trajectory in the
/// joint map (robot-1.tum and so on) into the folder, and prints the figures.
[[nodiscard]] Status run_merge_command(const MergeOptions& options, std::ostream& out);

}  // namespace seeker::lab
