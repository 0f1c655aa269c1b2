/// \file
/// Calibration of a stereo camera from pictures of a chessboard.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/result.hpp"
#include "server/drivers/camera/stereo_calibration.hpp"

namespace seeker::lab {

/// Inner corners and size of the squares.
struct Chessboard {
  int columns = 9;
  int rows = 6;
  double square_m = 0.025;
};

/// Positions of the board's corners in both eyes, in the same order, in pixels.
struct BoardView {
  std::string name;
  std::vector<std::pair<float, float>> left;
  std::vector<std::pair<float, float>> right;
};

/// Finds the corners. kNotFound: an eye that does not show the whole board, by name; kInvalidArgument: a board of less
/// than 3x3.
[[nodiscard]] Result<BoardView> find_board(const std::string& name, const Image& left, const Image& right,
                                           const Chessboard& board);

/// Calibrates from several views. kInvalidArgument: fewer than three views, or the result is no valid stereo camera.
[[nodiscard]] Result<drivers::StereoCalibration> calibrate_stereo(const std::vector<BoardView>& views,
                                                                  const Chessboard& board, int width_px, int height_px);

/// RMS distance in pixels between the corners of both eyes and their positions predicted by the calibration, with the
/// board pose that fits both eyes best. It is a fair measure for views that were not used in the calibration.
[[nodiscard]] double reprojection_error_px(const drivers::StereoCalibration& calibration, const BoardView& view,
                                           const Chessboard& board);

/// RMS difference in rows of the same corner in both rectified pictures, pixels.
[[nodiscard]] double row_error_px(const drivers::StereoCalibration& calibration, const BoardView& view);

}  // namespace seeker::lab
