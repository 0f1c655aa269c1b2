/// \file
/// `seeker-lab calibrate`: from a folder of chessboard pairs to a calibration file.
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
  std::vector<std::string> hold_out;  ///< names of pairs that only check the result
};

/// Columns and rows of inner corners from `9x6`. kInvalidArgument for anything else.
[[nodiscard]] Status parse_board(const std::string& text, Chessboard& board);

/// Writes the calibration file and a line a pair: its reprojection error and row error, and whether the calibration was
/// made from it. Pairs that do not show the whole board are told and left out. Errors: those of list_image_pairs(), of
/// the files and of calibrate_stereo(); kInvalidArgument: pictures of different sizes, an unknown pair held out.
[[nodiscard]] Status run_calibrate(const CalibrateOptions& options, std::ostream& report);

}  // namespace seeker::lab
