/// \file
/// seeker-lab slam: an estimator over a log, from the command line.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::lab {

struct SlamOptions {
  std::filesystem::path log;
  std::filesystem::path out;    ///< folder; empty: nothing is written
  std::filesystem::path robot;  ///< robot file, or the name of one in `config`/robots; empty: chosen by the log
  std::filesystem::path config;
  std::string estimator;  ///< empty: the robot file's
  std::vector<std::string> overrides;
  bool json = false;
  bool show_progress = false;
};

/// Runs, saves, and prints the figures to `out`. Errors of the files and options.
[[nodiscard]] Status run_slam_command(const SlamOptions& options, std::ostream& out);

/// The robot file that options name or the log asks for. Errors of the log.
[[nodiscard]] Result<std::filesystem::path> find_robot_file(const std::filesystem::path& robot,
                                                            const std::filesystem::path& config,
                                                            const std::filesystem::path& log);

}  // namespace seeker::lab
