#include "server/lab/stereo_database/stereo_calibrator.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace seeker::lab {
namespace {

using Corners = std::vector<cv::Point2f>;

constexpr std::size_t kFewestViews = 3;
/// Few views do not distinguish a sixth-order term from noise.
constexpr int kLens = cv::CALIB_FIX_K3;

std::vector<cv::Point3f> board_points(const Chessboard& board) {
  std::vector<cv::Point3f> points;
  points.reserve(static_cast<std::size_t>(board.columns) * static_cast<std::size_t>(board.rows));
  for (int r = 0; r < board.rows; ++r) {
    for (int c = 0; c < board.columns; ++c) {
      points.emplace_back(static_cast<float>(c * board.square_m), static_cast<float>(r * board.square_m), 0.0F);
    }
  }
  return points;
}

Corners corners_of(const std::vector<std::pair<float, float>>& places) {
  Corners corners;
  corners.reserve(places.size());
  for (const auto& [u, v] : places) {
    corners.emplace_back(u, v);
  }
  return corners;
}

std::vector<std::pair<float, float>> places_of(const Corners& corners) {
  std::vector<std::pair<float, float>> places;
  places.reserve(corners.size());
  for (const cv::Point2f& c : corners) {
    places.emplace_back(c.x, c.y);
  }
  return places;
}

Result<Corners> find_corners(const std::string& name, Image grey, const Chessboard& board) {
  const cv::Mat picture(grey.height_px(), grey.width_px(), CV_8U, grey.data().data());
  const cv::Size size(board.columns, board.rows);
  Corners corners;
  constexpr int kReach_px = 9;
  constexpr int kIterations = 40;
  constexpr double kExact_px = 0.005;
  if (cv::findChessboardCorners(picture, size, corners, cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE)) {
    cv::cornerSubPix(picture, corners, cv::Size(kReach_px, kReach_px), cv::Size(-1, -1),
                     cv::TermCriteria(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, kIterations, kExact_px));
    return corners;
  }
  // The thorough search takes seconds: only where the quick one finds nothing.
  if (!cv::findChessboardCornersSB(picture, size, corners, cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_ACCURACY)) {
    return fail(Errc::kNotFound, name + " does not show a whole board of " + std::to_string(board.columns) + "x" +
                                     std::to_string(board.rows) +
                                     " inner corners; check --board, or leave this pair out");
  }
  return corners;
}

std::array<double, 9> nine(const cv::Mat& m) {
  std::array<double, 9> values{};
  std::copy(m.begin<double>(), m.end<double>(), values.begin());
  return values;
}

cv::Mat matrix_of(const std::array<double, 9>& values) { return cv::Mat(cv::Matx33d(values.data()), true); }

using BoardPose = Eigen::Matrix<double, 6, 1>;  ///< in the left eye's frame: rotation vector, then translation

/// Differences of all corners of both eyes for a pose of the board, in pixels.
Eigen::VectorXd residuals(const drivers::StereoCalibration& c, const BoardView& view,
                          const std::vector<cv::Point3d>& points, const BoardPose& pose) {
  const cv::Vec3d rotation(pose[0], pose[1], pose[2]);
  const cv::Vec3d shift(pose[3], pose[4], pose[5]);
  cv::Vec3d between;
  cv::Rodrigues(cv::Matx33d(c.rotation.data()), between);
  cv::Vec3d right_rotation;
  cv::Vec3d right_shift;
  cv::composeRT(rotation, shift, between, cv::Vec3d(c.translation_m.data()), right_rotation, right_shift);
  std::array<std::vector<cv::Point2d>, 2> there;
  cv::projectPoints(points, rotation, shift, matrix_of(c.left.matrix), c.left.distortion, there[0]);
  cv::projectPoints(points, right_rotation, right_shift, matrix_of(c.right.matrix), c.right.distortion, there[1]);
  Eigen::VectorXd out(static_cast<Eigen::Index>(4 * points.size()));
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    out[at++] = there[0][i].x - static_cast<double>(view.left[i].first);
    out[at++] = there[0][i].y - static_cast<double>(view.left[i].second);
    out[at++] = there[1][i].x - static_cast<double>(view.right[i].first);
    out[at++] = there[1][i].y - static_cast<double>(view.right[i].second);
  }
  return out;
}

/// Gauss-Newton over both eyes.
BoardPose refine(const drivers::StereoCalibration& c, const BoardView& view, const std::vector<cv::Point3d>& points,
                 BoardPose pose) {
  constexpr int kSteps = 8;
  constexpr double kDelta = 1e-6;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::VectorXd here = residuals(c, view, points, pose);
    Eigen::MatrixXd jacobian(here.size(), pose.size());
    for (Eigen::Index i = 0; i < pose.size(); ++i) {
      BoardPose near = pose;
      near[i] += kDelta;
      jacobian.col(i) = (residuals(c, view, points, near) - here) / kDelta;
    }
    pose -= jacobian.colPivHouseholderQr().solve(here);
  }
  return pose;
}

}  // namespace

Result<BoardView> find_board(const std::string& name, const Image& left, const Image& right, const Chessboard& board) {
  constexpr int kLeast = 3;
  if (board.columns < kLeast || board.rows < kLeast || !(board.square_m > 0.0)) {
    return fail(Errc::kInvalidArgument, "a chessboard needs at least 3x3 inner corners and squares larger than 0");
  }
  const Result<Corners> l = find_corners("the left picture of pair '" + name + "'", to_grey(left), board);
  if (!l) {
    return tl::unexpected<Error>(l.error());
  }
  Result<Corners> r = find_corners("the right picture of pair '" + name + "'", to_grey(right), board);
  if (!r) {
    return tl::unexpected<Error>(r.error());
  }
  // A board can be read from either end; both eyes must begin at the same one.
  if ((l->back() - l->front()).dot(r->back() - r->front()) < 0.0F) {
    std::reverse(r->begin(), r->end());
  }
  return BoardView{name, places_of(*l), places_of(*r)};
}

Result<drivers::StereoCalibration> calibrate_stereo(const std::vector<BoardView>& views, const Chessboard& board,
                                                    int width_px, int height_px) {
  if (views.size() < kFewestViews) {
    return fail(Errc::kInvalidArgument, "a calibration needs at least three pairs that show the board, and got " +
                                            std::to_string(views.size()));
  }
  const std::vector<std::vector<cv::Point3f>> points(views.size(), board_points(board));
  std::vector<Corners> left;
  std::vector<Corners> right;
  left.reserve(views.size());
  right.reserve(views.size());
  for (const BoardView& view : views) {
    left.push_back(corners_of(view.left));
    right.push_back(corners_of(view.right));
  }
  const cv::Size size(width_px, height_px);
  drivers::StereoCalibration c;
  try {
    std::array<cv::Mat, 2> k;
    std::array<cv::Mat, 2> d;
    std::vector<cv::Mat> rotations;
    std::vector<cv::Mat> shifts;
    cv::calibrateCamera(points, left, size, k[0], d[0], rotations, shifts, kLens);
    cv::calibrateCamera(points, right, size, k[1], d[1], rotations, shifts, kLens);
    cv::Mat rotation;
    cv::Mat translation;
    cv::Mat essential;
    cv::Mat fundamental;
    c.reprojection_px = cv::stereoCalibrate(points, left, right, k[0], d[0], k[1], d[1], size, rotation, translation,
                                            essential, fundamental, cv::CALIB_USE_INTRINSIC_GUESS | kLens);
    c.width_px = width_px;
    c.height_px = height_px;
    c.left = {nine(k[0]), {d[0].begin<double>(), d[0].end<double>()}};
    c.right = {nine(k[1]), {d[1].begin<double>(), d[1].end<double>()}};
    c.rotation = nine(rotation);
    std::copy(translation.begin<double>(), translation.end<double>(), c.translation_m.begin());
  } catch (const cv::Exception&) {
    return fail(Errc::kInvalidArgument, "OpenCV cannot calibrate from these views; tilt the board more between them");
  }
  if (const Status valid = drivers::validate(c); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  return c;
}

double reprojection_error_px(const drivers::StereoCalibration& calibration, const BoardView& view,
                             const Chessboard& board) {
  const std::vector<cv::Point3f> flat = board_points(board);
  SEEKER_ASSERT(view.left.size() == flat.size() && view.right.size() == flat.size());
  const std::vector<cv::Point3d> points(flat.begin(), flat.end());
  cv::Vec3d rotation;
  cv::Vec3d shift;
  cv::solvePnP(flat, corners_of(view.left), matrix_of(calibration.left.matrix), calibration.left.distortion, rotation,
               shift);
  BoardPose pose;
  pose << rotation[0], rotation[1], rotation[2], shift[0], shift[1], shift[2];
  const Eigen::VectorXd rest = residuals(calibration, view, points, refine(calibration, view, points, pose));
  return std::sqrt(rest.squaredNorm() / static_cast<double>(2 * points.size()));
}

double row_error_px(const drivers::StereoCalibration& c, const BoardView& view) {
  const cv::Mat shift(cv::Vec3d(c.translation_m.data()));
  std::array<cv::Mat, 2> rotation;
  std::array<cv::Mat, 2> projection;
  cv::Mat reprojection;
  cv::stereoRectify(matrix_of(c.left.matrix), c.left.distortion, matrix_of(c.right.matrix), c.right.distortion,
                    cv::Size(c.width_px, c.height_px), matrix_of(c.rotation), shift, rotation[0], rotation[1],
                    projection[0], projection[1], reprojection, cv::CALIB_ZERO_DISPARITY, 0.0);
  Corners left;
  Corners right;
  cv::undistortPoints(corners_of(view.left), left, matrix_of(c.left.matrix), c.left.distortion, rotation[0],
                      projection[0]);
  cv::undistortPoints(corners_of(view.right), right, matrix_of(c.right.matrix), c.right.distortion, rotation[1],
                      projection[1]);
  double sum = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const auto d = static_cast<double>(left[i].y - right[i].y);
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(left.size()));
}

}  // namespace seeker::lab
