#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "common/config/number_text.hpp"
#include "server/lab/command/verbs.hpp"
#include "server/lab/solids/solids_study.hpp"
#include "server/lab/stereo_database/calibrate_command.hpp"
#include "server/lab/stereo_database/survey_command.hpp"

namespace seeker::lab {

Verb add_calibrate(CLI::App& app) {
  auto o = std::make_shared<CalibrateOptions>();
  auto board = std::make_shared<std::string>("9x6");
  CLI::App* verb = app.add_subcommand("calibrate", "A stereo camera from pairs of pictures of a chessboard");
  verb->add_option("folder", o->files.folder, "Folder with the pairs")->required();
  verb->add_option("--board", *board, "Inner corners of the board, COLUMNSxROWS")->capture_default_str();
  verb->add_option("--square", o->board.square_m, "Side of a square, m")
      ->required()
      ->check(config::number_above_zero, "above 0");
  verb->add_option("--out", o->out, "Calibration file to write (OpenCV YAML)")->required();
  verb->add_option("--left", o->files.left_pattern, "Names of left pictures")->capture_default_str();
  verb->add_option("--right", o->files.right_pattern, "Names of right pictures")->capture_default_str();
  verb->add_option("--hold-out", o->hold_out, "Pair that only checks the result (repeatable)");
  return [o, board] {
    if (const Status parsed = parse_board(*board, o->board); !parsed) {
      std::cerr << "seeker-lab: " << parsed.error().message << '\n';
      return static_cast<int>(kExitUsage);
    }
    const Status done = run_calibrate(*o, std::cout);
    return done ? static_cast<int>(kExitDone) : report_error(done.error().message);
  };
}

Verb add_survey(CLI::App& app) {
  auto o = std::make_shared<SurveyOptions>();
  auto config = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("survey", "A database of landmarks from pairs of pictures whose poses are known");
  verb->add_option("folder", o->folder, "Folder with the pairs and their poses")->required();
  verb->add_option("--name", o->name, "Name of the database")->required();
  verb->add_option("--out", o->out, "Folder to write NAME.seekerlm into, as STATE/landmarks of a robot")->required();
  verb->add_option("--poses", o->poses,
                   "In the folder: lines name,x_m,y_m,theta_deg of the left eye, with that heading")
      ->capture_default_str();
  verb->add_option("--calibration", o->calibration, "Of seeker-lab calibrate (default: the pictures are rectified)");
  verb->add_option("--left", o->left, "Names of left pictures")->capture_default_str();
  verb->add_option("--right", o->right, "Names of right pictures")->capture_default_str();
  verb->add_option("--robot", o->robot, "Robot file with the section `stereo` (default: robots/stereo.yaml)");
  verb->add_option("--config", *config, "Folder with robots/");
  verb->add_option("--set", o->overrides, "Override a field of the robot file: key.path=value (repeatable)");
  verb->add_flag("--replace", o->replace, "Replace an existing database of that name");
  verb->add_flag("--json", o->json, "Print JSON");
  return [o, config] {
    if (o->robot.empty()) {
      CommonOptions common;
      common.config = *config;
      o->robot = config_folder(common) / "robots" / "stereo.yaml";
    }
    o->show_progress = show_progress();
    const Status done = run_survey(*o, std::cout);
    return done ? static_cast<int>(kExitDone) : report_error(done.error().message);
  };
}

Verb add_train_solids(CLI::App& app) {
  auto o = std::make_shared<TrainSolidsOptions>();
  CLI::App* verb = app.add_subcommand("train-solids", "The recogniser of solids, from rendered pictures");
  verb->add_option("--out", o->out, "Model file to write (YAML)")->required();
  verb->add_option("--per-class", o->pictures.per_class, "Training pictures of each solid")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  verb->add_option("--seed", o->pictures.seed, "Seed of the pictures and of the training")->capture_default_str();
  return [o] {
    const Status done = run_train_solids(*o, std::cout);
    return done ? static_cast<int>(kExitDone) : report_error(done.error().message);
  };
}

}  // namespace seeker::lab
