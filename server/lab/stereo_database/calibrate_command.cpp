#include "server/lab/stereo_database/calibrate_command.hpp"

#include <algorithm>
#include <iomanip>
#include <set>

#include "common/core/number_in.hpp"

namespace seeker::lab {
namespace {

/// What was found in the pictures of a folder.
struct Boards {
  std::vector<BoardView> made_from;
  std::vector<BoardView> held_out;
  int width_px = 0;
  int height_px = 0;
};

Status add_pair(const drivers::ImagePair& pair, const CalibrateOptions& options, Boards& boards, std::ostream& report) {
  const Result<drivers::PairPictures> pictures = drivers::read_pair(pair);
  if (!pictures) {
    return tl::unexpected<Error>(pictures.error());
  }
  const Image& left = pictures->left;
  const Image& right = pictures->right;
  if (boards.width_px == 0) {
    boards.width_px = left.width_px();
    boards.height_px = left.height_px();
  }
  for (const Image* picture : {&left, &right}) {
    if (picture->width_px() != boards.width_px || picture->height_px() != boards.height_px) {
      return fail(Errc::kInvalidArgument, "pair '" + pair.name +
                                              "' has pictures of another size than the first one; take all of them "
                                              "with the same setting of the cameras");
    }
  }
  Result<BoardView> view = find_board(pair.name, left, right, options.board);
  if (!view && view.error().code == Errc::kNotFound) {
    report << "pair " << pair.name << ": left out, " << view.error().message << '\n';
    return {};
  }
  if (!view) {
    return tl::unexpected<Error>(view.error());
  }
  const bool held = std::find(options.hold_out.begin(), options.hold_out.end(), pair.name) != options.hold_out.end();
  (held ? boards.held_out : boards.made_from).push_back(std::move(*view));
  return {};
}

void print_view(const drivers::StereoCalibration& calibration, const BoardView& view, const Chessboard& board,
                const char* role, std::ostream& report) {
  report << "pair " << view.name << ": reprojection " << reprojection_error_px(calibration, view, board) << " px, rows "
         << row_error_px(calibration, view) << " px, " << role << '\n';
}

}  // namespace

Status parse_board(const std::string& text, Chessboard& board) {
  if (const std::size_t cross = text.find('x'); cross != std::string::npos) {
    const std::optional<int> columns = number_in<int>(std::string_view(text).substr(0, cross));
    const std::optional<int> rows = number_in<int>(std::string_view(text).substr(cross + 1));
    if (columns && rows) {
      board.columns = *columns;
      board.rows = *rows;
      return {};
    }
  }
  return fail(Errc::kInvalidArgument, "--board needs inner corners as COLUMNSxROWS, such as 9x6, not '" + text + "'");
}

Status run_calibrate(const CalibrateOptions& options, std::ostream& report) {
  const Result<std::vector<drivers::ImagePair>> pairs = drivers::list_image_pairs(options.files);
  if (!pairs) {
    return tl::unexpected<Error>(pairs.error());
  }
  std::set<std::string> unknown(options.hold_out.begin(), options.hold_out.end());
  for (const drivers::ImagePair& pair : *pairs) {
    unknown.erase(pair.name);
  }
  if (!unknown.empty()) {
    return fail(Errc::kInvalidArgument, "there is no pair '" + *unknown.begin() + "' to hold out");
  }
  Boards boards;
  report << std::fixed << std::setprecision(3);
  for (const drivers::ImagePair& pair : *pairs) {
    if (const Status added = add_pair(pair, options, boards, report); !added) {
      return added;
    }
  }
  const Result<drivers::StereoCalibration> calibration =
      calibrate_stereo(boards.made_from, options.board, boards.width_px, boards.height_px);
  if (!calibration) {
    return tl::unexpected<Error>(calibration.error());
  }
  const Result<drivers::Rectifier> rectifier = drivers::Rectifier::create(*calibration);
  if (!rectifier) {
    return tl::unexpected<Error>(rectifier.error());
  }
  if (const Status written = drivers::write_stereo_calibration(options.out, *calibration); !written) {
    return written;
  }
  for (const BoardView& view : boards.made_from) {
    print_view(*calibration, view, options.board, "made from it", report);
  }
  for (const BoardView& view : boards.held_out) {
    print_view(*calibration, view, options.board, "held out", report);
  }
  const StereoGeometry& g = rectifier->geometry();
  report << "rectified: " << g.width_px << "x" << g.height_px << ", focal length " << g.focal_px << " px, centre ("
         << g.centre_u_px << ", " << g.centre_v_px << ") px, baseline " << std::setprecision(4) << g.baseline_m
         << " m\n";
  return {};
}

}  // namespace seeker::lab
