#include "server/lab/command/commands.hpp"

#include <unistd.h>

#include <cstdio>
#include <map>

#include <CLI/CLI.hpp>

#include "common/files/config_folder.hpp"
#include "server/lab/command/verbs.hpp"

namespace seeker::lab {

void add_common(CLI::App& verb, CommonOptions& options) {
  verb.add_option("--out", options.out, "Folder for results; what is there already is not run again")->required();
  verb.add_option("--seeds", options.seeds, "Seeds, e.g. 1-20 or 1-3,7")->capture_default_str();
  verb.add_option("--jobs", options.jobs, "Runs at the same time")->check(CLI::Range(1, 256))->capture_default_str();
  verb.add_option("--set", options.overrides, "Override a field of the robot file: key.path=value (repeatable)");
  verb.add_option("--config", options.config, "Folder with robots/, worlds/, targets/, missions/");
  verb.add_option("--robot", options.robot, "Robot file, or the name of one in robots/ (default: sim)");
  verb.add_flag("--json", options.json, "Print JSON");
}

std::filesystem::path config_folder(const CommonOptions& options) {
  return options.config.empty() ? files::config_folder() : std::filesystem::path(options.config);
}

std::filesystem::path robot_file(const CommonOptions& options) {
  return files::named_file(options.robot.empty() ? "sim" : options.robot, config_folder(options) / "robots");
}

std::filesystem::path world_file(const CommonOptions& options, const std::string& name) {
  return files::named_file(name, config_folder(options) / "worlds");
}

bool show_progress() { return isatty(STDERR_FILENO) != 0; }

int report_error(const std::string& message) {
  std::fprintf(stderr, "seeker-lab: %s\n", message.c_str());
  return kExitFailed;
}

int run_lab(int argc, char** argv) {
  CLI::App app{
      "seeker-lab: experiments in the simulator, without network.\n"
      "Example: seeker-lab search --world office --strategy plan --seeds 1-20 --jobs 2 --out out/office"};
  app.set_version_flag("--version", std::string("seeker-lab ") + SEEKER_VERSION);
  app.require_subcommand(1);
  std::map<std::string, Verb> verbs;
  verbs["reproduce"] = add_reproduce(app);
  verbs["search"] = add_search(app);
  verbs["explore"] = add_explore(app);
  verbs["tour"] = add_tour(app);
  verbs["compare"] = add_compare(app);
  verbs["hit-rate"] = add_hit_rate(app);
  verbs["template"] = add_template(app);
  verbs["calibrate"] = add_calibrate(app);
  verbs["revisit"] = add_revisit(app);
  verbs["survey"] = add_survey(app);
  verbs["train-solids"] = add_train_solids(app);
  verbs["slam"] = add_slam(app);
  verbs["odometry-calibrate"] = add_odometry_calibrate(app);
  verbs["extrinsics"] = add_extrinsics(app);
  verbs["merge"] = add_merge(app);
  verbs["lines"] = add_lines(app);
  verbs["plot"] = add_plot(app);
  verbs["score-map"] = add_score_map(app);
  verbs["score"] = add_score(app);
  verbs["trajectory"] = add_trajectory(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitDone : kExitUsage;
  }
  return verbs.at(app.get_subcommands().front()->get_name())();
}

}  // namespace seeker::lab
