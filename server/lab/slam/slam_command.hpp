/// \file
/// Command `seeker-lab slam`: an estimator on a recorded log.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::lab {

struct SlamOptions {
  std::filesystem::path log;
  std::filesystem::path out;    ///< folder; empty: no file is written
  std::filesystem::path robot;  ///< robot file, or the name of one in `config`/robots; empty: chosen by the log
  std::filesystem::path config;
  std::string estimator;  ///< empty: the one of the robot file
  std::vector<std::string> overrides;
  bool json = false;
  bool show_progress = false;
};

/// Runs the estimator, saves the results, and prints the figures to `out`. Errors of the files and options.
[[nodiscard]] Status run_slam_command(const SlamOptions& options, std::ostream& out);

}  // namespace seeker::lab
