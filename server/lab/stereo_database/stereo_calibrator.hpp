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

/// Places of the board's corners in both eyes, in the same order; pixels.
struct BoardView {
  std::string name;
  std::vector<std::pair<float, float>> left;
  std::vector<std::pair<float, float>> right;
};

/// kNotFound: an eye that does not see the whole board, by name; kInvalidArgument: a board of less than 3x3.
[[nodiscard]] Result<BoardView> find_board(const std::string& name, const Image& left, const Image& right,
                                           const Chessboard& board);

/// kInvalidArgument: fewer than three views, or what they give is no stereo camera.
[[nodiscard]] Result<drivers::StereoCalibration> calibrate_stereo(const std::vector<BoardView>& views,
                                                                  const Chessboard& board, int width_px, int height_px);

/// RMS distance in pixels between the corners of both eyes and where a calibration puts them, the board's pose being
/// the best one for both eyes: fair for views that the calibration was not made from.
[[nodiscard]] double reprojection_error_px(const drivers::StereoCalibration& calibration, const BoardView& view,
                                           const Chessboard& board);

/// RMS difference in rows of the same corner in both rectified pictures, pixels.
[[nodiscard]] double row_error_px(const drivers::StereoCalibration& calibration, const BoardView& view);

}  // namespace seeker::lab
