/// \file
/// seeker-lab merge: the maps of recorded runs, or maps that robots saved, laid upon each other from the command line.
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
  std::vector<std::filesystem::path> logs;  ///< or map files (*.seekermap), taken as they are
  std::vector<std::string> spans;           ///< one a log, in per cent of its duration, e.g. 0-50; none: whole logs
  std::filesystem::path out;                ///< folder; empty: nothing is written
  std::filesystem::path robot;              ///< robot file for all logs; empty: chosen by each log
  std::filesystem::path config;
  std::vector<std::string> overrides;
  bool json = false;
  bool show_progress = false;
};

/// One log or map as a robot of its own.
struct MergedLog {
  std::string name;
  SlamRun run;  ///< of a map file: the map alone
  double prepare_s = 0.0;
};

/// What came of it.
struct MergeRun {
  std::vector<MergedLog> logs;  ///< by slot
  std::vector<fleet::PairAnswer> pairs;
  fleet::JointMap joint;
  double merge_s = 0.0;
  double join_s = 0.0;
};

/// "0-50" in per cent. kInvalidArgument: something else, or nothing between them.
[[nodiscard]] Result<LogSpan> parse_span(const std::string& text);
/// Line SLAM over each log, then the merger over each pair of them and of the maps. Errors of the files and options;
/// kInvalidArgument: a span where a map is among them.
[[nodiscard]] Result<MergeRun> merge_logs(const MergeOptions& options);
[[nodiscard]] std::string merge_text(const MergeRun& run);
[[nodiscard]] std::string merge_json(const MergeRun& run);
/// The walls of all that were joined and the ways of the robots, in one frame.
[[nodiscard]] Result<Image> merge_picture(const MergeRun& run);
/// Runs, writes report.json, merged.png and merged.seekermap into the folder, and prints.
[[nodiscard]] Status run_merge_command(const MergeOptions& options, std::ostream& out);

}  // namespace seeker::lab
