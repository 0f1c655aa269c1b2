#include "server/lab/stereo_database/calibrate_command.hpp"

#include <sstream>

#include "common/image/jpeg.hpp"
#include "tests/support/data.hpp"
#include "tests/unit/server/lab/experiments/files.hpp"

namespace seeker::lab {
namespace {

using Calibrate = LabFiles;

CalibrateOptions options_for(const std::filesystem::path& pictures, const std::filesystem::path& out) {
  CalibrateOptions options;
  options.files.folder = pictures;
  options.board.square_m = 0.03;
  options.out = out;
  return options;
}

TEST_F(Calibrate, ThreeRealPairsGiveHalfAPixelOnTheFourth) {
  SEEKER_REQUIRE_DATA(pictures, "vision/stereo_1024x768");
  CalibrateOptions options = options_for(pictures, folder() / "stereo.yaml");
  options.hold_out = {"3"};
  std::ostringstream report;
  const Status done = run_calibrate(options, report);
  ASSERT_TRUE(done) << done.error().message;
  const auto calibration = drivers::read_stereo_calibration(options.out);
  ASSERT_TRUE(calibration) << calibration.error().message;
  const auto left = image::read_picture(pictures / "3_left.jpg");
  const auto right = image::read_picture(pictures / "3_right.jpg");
  const auto view = find_board("3", *left, *right, options.board);
  ASSERT_TRUE(view) << view.error().message;
  EXPECT_LT(reprojection_error_px(*calibration, *view, options.board), 0.5);
  EXPECT_NE(report.str().find("held out"), std::string::npos);

  // After rectification the squares of the held-out board have their size, by disparity alone.
  const auto rectifier = drivers::Rectifier::create(*calibration);
  ASSERT_TRUE(rectifier) << rectifier.error().message;
  const auto frame = rectifier->rectify({}, *left, *right);
  const auto flat = find_board("3", frame->left, frame->right, options.board);
  ASSERT_TRUE(flat) << flat.error().message;
  const StereoGeometry& g = rectifier->geometry();
  const auto place = [&](std::size_t i) {
    const double d = static_cast<double>(flat->left[i].first - flat->right[i].first);
    EXPECT_LT(std::abs(flat->left[i].second - flat->right[i].second), 0.5F);
    const double z = g.focal_px * g.baseline_m / d;
    return std::array<double, 3>{(static_cast<double>(flat->left[i].first) - g.centre_u_px) * z / g.focal_px,
                                 (static_cast<double>(flat->left[i].second) - g.centre_v_px) * z / g.focal_px, z};
  };
  const auto a = place(0);
  const auto b = place(8);  // the other end of the first row
  EXPECT_NEAR(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), 8 * options.board.square_m, 0.01);
}

TEST_F(Calibrate, TellsWhatIsWrongWithThePictures) {
  SEEKER_REQUIRE_DATA(pictures, "vision/stereo_1024x768");
  std::ostringstream report;
  CalibrateOptions options = options_for(pictures, folder() / "stereo.yaml");
  options.hold_out = {"7"};
  EXPECT_EQ(run_calibrate(options, report).error().code, Errc::kInvalidArgument);
  options.hold_out.clear();
  options.files.folder = folder();
  EXPECT_EQ(run_calibrate(options, report).error().code, Errc::kNotFound);
  EXPECT_FALSE(std::filesystem::exists(options.out));
}

TEST(Chessboard, IsWrittenAsColumnsTimesRows) {
  Chessboard board;
  ASSERT_TRUE(parse_board("7x5", board));
  EXPECT_EQ(board.columns, 7);
  EXPECT_EQ(board.rows, 5);
  for (const char* text : {"7", "7x", "x5", "7x5x3", "seven", ""}) {
    EXPECT_EQ(parse_board(text, board).error().code, Errc::kInvalidArgument) << text;
  }
  const Image blank(100, 80, 1, 128);
  EXPECT_EQ(find_board("a", blank, blank, {9, 6, 0.02}).error().code, Errc::kNotFound);
  EXPECT_EQ(find_board("a", blank, blank, {2, 6, 0.02}).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(calibrate_stereo({}, {9, 6, 0.02}, 100, 80).error().code, Errc::kInvalidArgument);
}

}  // namespace
}  // namespace seeker::lab
