#include "server/drivers/camera/stereo_calibration.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "common/files/files.hpp"

namespace seeker::drivers {
namespace {

constexpr std::size_t kMaxFile_bytes = std::size_t{1} << 20U;

tl::unexpected<Error> refuse(const std::string& why) {
  return fail(Errc::kInvalidArgument, "stereo calibration: " + why + "; calibrate again with seeker-lab calibrate");
}

bool finite(const auto& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

Status check_eye(const EyeCalibration& eye, const char* which, const StereoCalibration& whole) {
  constexpr std::array<std::size_t, 5> kLengths{4, 5, 8, 12, 14};
  const auto& k = eye.matrix;
  const bool pinhole = k[0] > 1.0 && k[4] > 1.0 && k[2] > 0.0 && k[2] < whole.width_px && k[5] > 0.0 &&
                       k[5] < whole.height_px && k[3] == 0.0 && k[6] == 0.0 && k[7] == 0.0 && k[8] == 1.0;
  if (!finite(k) || !pinhole) {
    return refuse(std::string("the ") + which + " camera's matrix is none of a camera with this picture size");
  }
  if (!finite(eye.distortion) || std::find(kLengths.begin(), kLengths.end(), eye.distortion.size()) == kLengths.end()) {
    return refuse(std::string("the ") + which + " camera's distortion needs 4, 5, 8, 12 or 14 finite numbers");
  }
  return {};
}

cv::Mat matrix_of(const std::array<double, 9>& values) {
  return cv::Mat(3, 3, CV_64F, const_cast<double*>(values.data())).clone();  // cv::Mat has no read-only view
}

template <std::size_t N>
bool read_numbers(const cv::FileNode& node, std::array<double, N>& out) {
  cv::Mat m;
  node >> m;
  if (m.total() != N || m.channels() != 1) {
    return false;
  }
  m.convertTo(m, CV_64F);
  std::copy(m.begin<double>(), m.end<double>(), out.begin());
  return true;
}

bool read_distortion(const cv::FileNode& node, std::vector<double>& out) {
  constexpr std::size_t kMost = 14;
  cv::Mat m;
  node >> m;
  if (m.empty() || m.total() > kMost || m.channels() != 1) {
    return false;
  }
  m.convertTo(m, CV_64F);
  out.assign(m.begin<double>(), m.end<double>());
  return true;
}

/// Throws cv::Exception for what is no YAML.
Result<StereoCalibration> read_storage(const std::string& text) {
  const cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  StereoCalibration c;
  const auto missing = [](const char* field) {
    return fail(Errc::kParse, std::string("stereo calibration: the field '") + field +
                                  "' is missing or of another shape; calibrate again with seeker-lab calibrate");
  };
  if (!file.isOpened() || !file["image_width"].isInt() || !file["image_height"].isInt()) {
    return missing("image_width' or 'image_height");
  }
  c.width_px = static_cast<int>(file["image_width"]);
  c.height_px = static_cast<int>(file["image_height"]);
  if (!read_numbers(file["camera_matrix_left"], c.left.matrix)) {
    return missing("camera_matrix_left");
  }
  if (!read_numbers(file["camera_matrix_right"], c.right.matrix)) {
    return missing("camera_matrix_right");
  }
  if (!read_distortion(file["distortion_left"], c.left.distortion)) {
    return missing("distortion_left");
  }
  if (!read_distortion(file["distortion_right"], c.right.distortion)) {
    return missing("distortion_right");
  }
  if (!read_numbers(file["rotation"], c.rotation)) {
    return missing("rotation");
  }
  if (!read_numbers(file["translation_m"], c.translation_m)) {
    return missing("translation_m");
  }
  if (file["reprojection_px"].isReal() || file["reprojection_px"].isInt()) {
    c.reprojection_px = static_cast<double>(file["reprojection_px"]);
  }
  return c;
}

}  // namespace

Status validate(const StereoCalibration& c) {
  if (c.width_px < 1 || c.height_px < 1 || c.width_px > kMaxImageSide_px || c.height_px > kMaxImageSide_px) {
    return refuse("the picture size must be in 1..8192");
  }
  if (const Status left = check_eye(c.left, "left", c); !left) {
    return left;
  }
  if (const Status right = check_eye(c.right, "right", c); !right) {
    return right;
  }
  constexpr double kSlack = 1e-3;
  const cv::Mat r = matrix_of(c.rotation);
  const cv::Mat rest = r * r.t() - cv::Mat::eye(3, 3, CV_64F);
  if (!finite(c.rotation) || cv::norm(rest) > kSlack || cv::determinant(r) < 0.0) {
    return refuse("the rotation between the eyes is no rotation");
  }
  constexpr double kLeast_m = 1e-3;
  constexpr double kMost_m = 10.0;
  const double length_m = cv::norm(cv::Vec3d(c.translation_m.data()));
  if (!finite(c.translation_m) || length_m < kLeast_m || length_m > kMost_m) {
    return refuse("the eyes must be between 1 mm and 10 m apart");
  }
  if (c.translation_m[0] > 0.0) {
    return fail(Errc::kInvalidArgument, "stereo calibration: the right camera is left of the left one; exchange them");
  }
  if (std::abs(c.translation_m[0]) < std::abs(c.translation_m[1])) {
    return refuse("the eyes stand one above the other");
  }
  return {};
}

Result<StereoCalibration> parse_stereo_calibration(std::string_view text) {
  try {
    Result<StereoCalibration> calibration = read_storage(std::string(text));
    if (!calibration) {
      return calibration;
    }
    if (const Status valid = validate(*calibration); !valid) {
      return tl::unexpected<Error>(valid.error());
    }
    return calibration;
  } catch (const cv::Exception&) {
    return fail(Errc::kParse, "stereo calibration: this is no YAML file of OpenCV (first line '%YAML:1.0')");
  }
}

std::string to_yaml(const StereoCalibration& c) {
  cv::FileStorage file("calibration.yaml",
                       cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  file << "image_width" << c.width_px << "image_height" << c.height_px;
  file << "camera_matrix_left" << matrix_of(c.left.matrix);
  file << "distortion_left" << cv::Mat(c.left.distortion, true).t();
  file << "camera_matrix_right" << matrix_of(c.right.matrix);
  file << "distortion_right" << cv::Mat(c.right.distortion, true).t();
  file << "rotation" << matrix_of(c.rotation);
  file << "translation_m" << cv::Mat(cv::Vec3d(c.translation_m.data()));
  file << "reprojection_px" << c.reprojection_px;
  return file.releaseAndGetString();
}

Result<StereoCalibration> read_stereo_calibration(const std::filesystem::path& path) {
  const Result<std::vector<std::uint8_t>> bytes = files::read_file(path, kMaxFile_bytes);
  if (!bytes) {
    return fail_with_context("stereo calibration", bytes.error());
  }
  Result<StereoCalibration> calibration = parse_stereo_calibration(std::string(bytes->begin(), bytes->end()));
  if (!calibration) {
    return fail_with_context(path.string(), calibration.error());
  }
  return calibration;
}

Status write_stereo_calibration(const std::filesystem::path& path, const StereoCalibration& calibration) {
  return files::write_file(path, to_yaml(calibration));
}

Result<Rectifier> Rectifier::create(const StereoCalibration& c) {
  if (const Status valid = validate(c); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  const std::array<const EyeCalibration*, 2> eyes{&c.left, &c.right};
  const cv::Size size(c.width_px, c.height_px);
  const cv::Mat translation(cv::Vec3d(c.translation_m.data()));
  std::array<cv::Mat, 2> rotation;
  std::array<cv::Mat, 2> projection;
  Rectifier rectifier;
  try {
    cv::Mat reprojection;
    cv::stereoRectify(matrix_of(c.left.matrix), c.left.distortion, matrix_of(c.right.matrix), c.right.distortion, size,
                      matrix_of(c.rotation), translation, rotation[0], rotation[1], projection[0], projection[1],
                      reprojection, cv::CALIB_ZERO_DISPARITY, 0.0, size);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
      cv::initUndistortRectifyMap(matrix_of(eyes[i]->matrix), eyes[i]->distortion, rotation[i], projection[i], size,
                                  CV_16SC2, rectifier.eyes_[i].map, rectifier.eyes_[i].weights);
    }
  } catch (const cv::Exception&) {
    return refuse("OpenCV cannot rectify with it");
  }
  const double focal_px = projection[0].at<double>(0, 0);
  rectifier.geometry_ = {c.width_px,
                         c.height_px,
                         focal_px,
                         projection[0].at<double>(0, 2),
                         projection[0].at<double>(1, 2),
                         -projection[1].at<double>(0, 3) / focal_px};
  if (!seeker::validate(rectifier.geometry_)) {
    return refuse("its eyes have no field of view in common");
  }
  return rectifier;
}

Result<Rectifier> Rectifier::none(const StereoGeometry& geometry) {
  if (const Status valid = seeker::validate(geometry); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  Rectifier rectifier;
  rectifier.geometry_ = geometry;
  return rectifier;
}

Result<Image> Rectifier::rectify_eye(const char* which, const Eye& eye, const Image& picture) const {
  if (picture.width_px() != geometry_.width_px || picture.height_px() != geometry_.height_px) {
    const auto size = [](int width, int height) { return std::to_string(width) + "x" + std::to_string(height); };
    return fail(Errc::kInvalidArgument,
                std::string("the ") + which + " picture is " + size(picture.width_px(), picture.height_px()) +
                    " pixels, the camera was calibrated with " + size(geometry_.width_px, geometry_.height_px) +
                    "; set the camera to that size or calibrate it again");
  }
  Image grey = to_grey(picture);
  if (eye.map.empty()) {
    return grey;
  }
  Image out(grey.width_px(), grey.height_px(), 1);
  const cv::Mat in(grey.height_px(), grey.width_px(), CV_8U, grey.data().data());
  cv::Mat result(out.height_px(), out.width_px(), CV_8U, out.data().data());
  cv::remap(in, result, eye.map, eye.weights, cv::INTER_LINEAR);
  return out;
}

Result<StereoFrame> Rectifier::rectify(RobotTime stamp, const Image& left, const Image& right) const {
  Result<Image> rectified_left = rectify_eye("left", eyes_[0], left);
  if (!rectified_left) {
    return tl::unexpected<Error>(rectified_left.error());
  }
  Result<Image> rectified_right = rectify_eye("right", eyes_[1], right);
  if (!rectified_right) {
    return tl::unexpected<Error>(rectified_right.error());
  }
  return StereoFrame{stamp, std::move(*rectified_left), std::move(*rectified_right)};
}

}  // namespace seeker::drivers
