/// \file
/// The verbs of seeker-lab: each adds its options and runs with them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace seeker::lab {

/// What a verb returns as the program's exit code.
enum ExitCode : int { kExitDone = 0, kExitFailed = 1, kExitUsage = 2 };

/// Options common to all verbs with runs.
struct CommonOptions {
  std::filesystem::path out;
  std::string seeds = "1-20";
  std::vector<std::string> overrides;
  std::string config;  ///< folder of the configuration; empty: files::config_folder()
  std::string robot;   ///< robot file, or the name of one in robots/; empty: sim
  int jobs = 1;
  bool json = false;
};
void add_common(CLI::App& verb, CommonOptions& options);

/// The path of a file named on the command line: as it is, or NAME.yaml in a folder of the configuration.
[[nodiscard]] std::filesystem::path config_folder(const CommonOptions& options);
[[nodiscard]] std::filesystem::path robot_file(const CommonOptions& options);
[[nodiscard]] std::filesystem::path world_file(const CommonOptions& options, const std::string& name);
/// Whether to show progress: only where stderr is a terminal.
[[nodiscard]] bool show_progress();
/// Prints the error and returns kExitFailed.
[[nodiscard]] int report_error(const std::string& message);

/// Names of the strategies of exploration.
[[nodiscard]] std::vector<std::string> explore_strategies();

/// Each function sets up a verb; the returned function runs it.
using Verb = std::function<int()>;
[[nodiscard]] Verb add_reproduce(CLI::App& app);
[[nodiscard]] Verb add_search(CLI::App& app);
[[nodiscard]] Verb add_explore(CLI::App& app);
[[nodiscard]] Verb add_tour(CLI::App& app);
[[nodiscard]] Verb add_compare(CLI::App& app);
[[nodiscard]] Verb add_hit_rate(CLI::App& app);
[[nodiscard]] Verb add_template(CLI::App& app);
[[nodiscard]] Verb add_calibrate(CLI::App& app);
[[nodiscard]] Verb add_revisit(CLI::App& app);
[[nodiscard]] Verb add_survey(CLI::App& app);
[[nodiscard]] Verb add_train_solids(CLI::App& app);
[[nodiscard]] Verb add_slam(CLI::App& app);
[[nodiscard]] Verb add_odometry_calibrate(CLI::App& app);
[[nodiscard]] Verb add_extrinsics(CLI::App& app);
[[nodiscard]] Verb add_merge(CLI::App& app);
[[nodiscard]] Verb add_lines(CLI::App& app);
[[nodiscard]] Verb add_plot(CLI::App& app);
[[nodiscard]] Verb add_score_map(CLI::App& app);
[[nodiscard]] Verb add_score(CLI::App& app);
[[nodiscard]] Verb add_trajectory(CLI::App& app);

}  // namespace seeker::lab
