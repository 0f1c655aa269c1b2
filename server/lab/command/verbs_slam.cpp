#include <iostream>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>

#include "common/config/number_text.hpp"
#include "common/core/angle.hpp"
#include "server/lab/calibration/calibration_command.hpp"
#include "server/lab/command/verbs.hpp"
#include "server/lab/line_detection/lines_command.hpp"
#include "server/lab/map_merging/merge_command.hpp"
#include "server/lab/scoring/score_command.hpp"
#include "server/lab/scoring/score_map.hpp"
#include "server/lab/slam/plot_trajectories.hpp"
#include "server/lab/slam/slam_command.hpp"
#include "server/lab/slam/slam_estimators.hpp"

namespace seeker::lab {
namespace {

int exit_code_of(const Status& done) { return done ? kExitDone : report_error(done.error().message); }

/// Options of every verb that plays a log.
template <class Options>
void add_geometry(CLI::App& verb, Options& options) {
  verb.add_option("--robot", options.robot,
                  "Robot file with the scanner's geometry, or the name of one in robots/ (default: chosen by the log)");
  verb.add_option("--config", options.config, "Folder with robots/");
  verb.add_option("--set", options.overrides, "Override a field of the robot file: key.path=value (repeatable)");
}

std::filesystem::path found_config(const std::filesystem::path& named) {
  CommonOptions common;
  common.config = named.string();
  return config_folder(common);
}

/// Both calibrations of a recorded drive.
Verb add_calibration(CLI::App& verb, calibration::CalibrationSubject subject) {
  auto o = std::make_shared<CalibrationOptions>();
  verb.add_option("log", o->log, "Log of a drive with straight legs and turns, e.g. of seekerd --record")->required();
  verb.add_option("--out", o->out, "YAML file for the section of the robot file (default: none is written)");
  verb.add_option("--estimator", o->estimator, "Which estimator follows the laser (default: the robot file's)")
      ->check(CLI::IsMember(estimator_names()));
  add_geometry(verb, *o);
  verb.add_flag("--json", o->json, "Print JSON");
  return [o, subject] {
    o->config = found_config(o->config);
    return exit_code_of(run_calibration(*o, subject, std::cout));
  };
}

}  // namespace

Verb add_slam(CLI::App& app) {
  auto o = std::make_shared<SlamOptions>();
  CLI::App* verb = app.add_subcommand("slam", "An estimator over a recorded log: trajectory, map and what it cost");
  verb->add_option("log", o->log, "CARMEN log, or scans as numbers with commas; plain or .gz")->required();
  verb->add_option("--out", o->out,
                   "Folder for trajectory.tum, map.png, walls.csv, report.json and, where past poses were mended, "
                   "trajectory_online.tum (default: nothing is written)");
  verb->add_option("--estimator", o->estimator, "Which estimator (default: the robot file's)")
      ->check(CLI::IsMember(estimator_names()));
  add_geometry(*verb, *o);
  verb->add_flag("--json", o->json, "Print JSON");
  return [o] {
    o->config = found_config(o->config);
    o->show_progress = show_progress();
    return exit_code_of(run_slam_command(*o, std::cout));
  };
}

Verb add_odometry_calibrate(CLI::App& app) {
  return add_calibration(
      *app.add_subcommand("odometry-calibrate", "Scales of the wheels and their track, from a recorded drive"),
      calibration::CalibrationSubject::kWheels);
}

Verb add_extrinsics(CLI::App& app) {
  return add_calibration(*app.add_subcommand("extrinsics", "Pose of the laser on the base, from a recorded drive"),
                         calibration::CalibrationSubject::kMount);
}

Verb add_merge(CLI::App& app) {
  auto o = std::make_shared<MergeOptions>();
  CLI::App* verb =
      app.add_subcommand("merge", "Maps of recorded runs, or saved ones, laid upon each other by lidar alone");
  verb->add_option("logs", o->logs, "Logs or map files (*.seekermap), each taken for a robot of its own")->required();
  verb->add_option("--span", o->spans, "Part of a log in per cent of its duration, e.g. 0-50; one for each log");
  verb->add_option("--out", o->out,
                   "Folder for report.json, merged.png, merged.seekermap and the trajectories in the joint map, "
                   "robot-1.tum and so on (default: none is written)");
  add_geometry(*verb, *o);
  verb->add_flag("--json", o->json, "Print JSON");
  return [o] {
    o->config = found_config(o->config);
    o->show_progress = show_progress();
    return exit_code_of(run_merge_command(*o, std::cout));
  };
}

Verb add_score(CLI::App& app) {
  auto o = std::make_shared<ScoreOptions>();
  CLI::App* verb = app.add_subcommand("score", "Errors of a trajectory against relations or a reference");
  verb->add_option("trajectory", o->trajectory, "TUM file: t x y z qx qy qz qw")->required();
  CLI::Option* relations =
      verb->add_option("--relations", o->relations, "True motions: t1 t2 dx dy dz roll pitch yaw, plain or .gz");
  CLI::Option* reference =
      verb->add_option("--reference", o->reference, "True poses of the base: TUM or t,x,y,theta")->excludes(relations);
  verb->add_option("--corrections", o->corrections, "A localiser's map -> odom: t,x,y,theta; needs --odometry")
      ->excludes(relations)
      ->excludes(reference);
  verb->add_option("--time-offset", o->params.offset_s, "Clock of the relations minus clock of the log, s")
      ->capture_default_str();
  verb->add_option("--odometry", o->odometry, "Log whose odometry carries poses between scans (else interpolated)");
  verb->add_option("--max-gap", o->params.max_gap_s, "A time without a pose this near is missed, s")
      ->check(config::number_above_zero, "above 0")
      ->capture_default_str();
  verb->add_flag("--exact-only", o->exact_only, "Only relations between scans that the log calls exactly stamped");
  verb->add_flag("--json", o->json, "Print JSON");
  return [o] { return exit_code_of(run_score(*o, std::cout, std::cerr)); };
}

Verb add_trajectory(CLI::App& app) {
  struct Options {
    std::filesystem::path log;
    std::filesystem::path out;
    std::string source = "odometry";
  };
  auto o = std::make_shared<Options>();
  static const std::map<std::string, LogPoseSource> kSources = {{"odometry", LogPoseSource::kOdometry},
                                                                {"corrected", LogPoseSource::kCorrected}};
  CLI::App* verb = app.add_subcommand("trajectory", "Writes the poses that a log holds as a TUM file");
  verb->add_option("log", o->log, "Log, plain or .gz")->required();
  verb->add_option("--source", o->source, "odometry, or a mapper's corrected poses")
      ->check(CLI::IsMember(kSources))
      ->capture_default_str();
  verb->add_option("--out", o->out, "TUM file to write")->required();
  return [o] { return exit_code_of(write_log_trajectory(o->log, kSources.at(o->source), o->out, std::cerr)); };
}

Verb add_score_map(CLI::App& app) {
  auto o = std::make_shared<ScoreMapOptions>();
  auto initial = std::make_shared<std::vector<double>>();
  CLI::App* verb = app.add_subcommand("score-map", "Distance of a map's walls to those of a ROS map");
  verb->add_option("walls", o->walls, "GeoJSON with lines in metres, or lines `x,y` or `x1,y1,x2,y2`")->required();
  verb->add_option("--map-yaml", o->map_yaml, "The ROS map")->required();
  verb->add_option("--initial", *initial, "Look for the fit near x m, y m, heading deg (default: everywhere)")
      ->expected(3);
  verb->add_flag("--json", o->json, "Print JSON");
  return [o, initial] {
    if (!initial->empty()) {
      o->params.initial = Pose2{initial->at(0), initial->at(1), deg_to_rad(initial->at(2))};
    }
    return exit_code_of(run_score_map(*o, std::cout, std::cerr));
  };
}

Verb add_lines(CLI::App& app) {
  auto o = std::make_shared<LinesOptions>();
  CLI::App* verb = app.add_subcommand("lines", "The line extractor over a recorded log");
  verb->add_option("log", o->log, "CARMEN log, or scans as numbers with commas; plain or .gz")->required();
  verb->add_option("--extractor", o->extractor, "How lines are found (default: as the robot file says)")
      ->check(CLI::IsMember({"fast", "five_modes", "regression", "split_and_merge", "iepf"}));
  CLI::Option* scan = verb->add_option("--scan", o->scan, "Draw this scan instead; the first is 0");
  scan->needs(verb->add_option("--out", o->out, "PNG of that scan")->needs(scan));
  add_geometry(*verb, *o);
  verb->add_flag("--json", o->json, "Print JSON");
  return [o] {
    o->config = found_config(o->config);
    return exit_code_of(run_lines(*o, std::cout));
  };
}

Verb add_plot(CLI::App& app) {
  auto o = std::make_shared<PlotOptions>();
  CLI::App* verb = app.add_subcommand("plot", "Trajectories over each other, and the walls of a log");
  verb->add_option("trajectories", o->trajectories, "TUM files")->required();
  verb->add_option("--log", o->log, "Draw the walls: its scans at the poses of the first trajectory");
  verb->add_flag("--align", o->align, "Move each trajectory onto the first");
  verb->add_option("--out", o->out, "PNG to write")->required();
  add_geometry(*verb, *o);
  return [o] {
    o->config = found_config(o->config);
    return exit_code_of(run_plot(*o, std::cout));
  };
}

}  // namespace seeker::lab
