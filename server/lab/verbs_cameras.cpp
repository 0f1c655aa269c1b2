#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "server/lab/calibrate_command.hpp"
#include "server/lab/verbs.hpp"

namespace seeker::lab {

Verb add_calibrate(CLI::App& app) {
  auto o = std::make_shared<CalibrateOptions>();
  auto board = std::make_shared<std::string>("9x6");
  CLI::App* verb = app.add_subcommand("calibrate", "A stereo camera from pairs of pictures of a chessboard");
  verb->add_option("folder", o->files.folder, "Folder with the pairs")->required();
  verb->add_option("--board", *board, "Inner corners of the board, COLUMNSxROWS")->capture_default_str();
  verb->add_option("--square", o->board.square_m, "Side of a square, m")->required()->check(CLI::PositiveNumber);
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

}  // namespace seeker::lab
