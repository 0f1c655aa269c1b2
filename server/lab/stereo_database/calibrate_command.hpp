/// \file
/// Command `seeker-lab calibrate`: makes a calibration file from a folder of chessboard pairs.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "server/drivers/camera/image_folder.hpp"
#include "server/lab/stereo_database/stereo_calibrator.hpp"

namespace seeker::lab {

struct CalibrateOptions {
  drivers::ImageFolderParams files;
  Chessboard board;
  std::filesystem::path out;
  std::vector<std::string> hold_out;  ///< names of pairs that are used only to check the result
};

/// Parses the columns and rows of inner corners from `9x6`. kInvalidArgument: any other form.
[[nodiscard]] Status parse_board(const std::string& text, Chessboard& board);

/// Writes the calibration file and a line for each pair: its reprojection error and row error, and whether it was used
/// for the calibration. Pairs that do not show the whole board are reported and left out. Errors: those of
/// list_image_pairs(), of the files and of calibrate_stereo(); kInvalidArgument: pictures of different sizes, an
/// unknown pair held out.
[[nodiscard]] Status run_calibrate(const CalibrateOptions& options, std::ostream& report);

}  // namespace seeker::lab
