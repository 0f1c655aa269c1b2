/// \file
/// The calibration of two cameras that `seeker-lab calibrate` estimates, as an OpenCV YAML file, and the resulting
/// rectification.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core.hpp>

#include "common/core/image.hpp"
#include "common/core/result.hpp"
#include "common/core/stereo.hpp"

namespace seeker::drivers {

/// Pinhole model with distortion, as in OpenCV.
struct EyeCalibration {
  std::array<double, 9> matrix{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};  ///< row by row
  std::vector<double> distortion;  ///< k1 k2 p1 p2 [k3 [k4 k5 k6 [...]]]: 4, 5, 8, 12 or 14 numbers

  friend bool operator==(const EyeCalibration&, const EyeCalibration&) = default;
};

/// p_right = rotation p_left + translation, in OpenCV's axes (x right, y down, z ahead).
struct StereoCalibration {
  int width_px = 0;
  int height_px = 0;
  EyeCalibration left;
  EyeCalibration right;
  std::array<double, 9> rotation{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};  ///< row by row
  std::array<double, 3> translation_m{-0.12, 0.0, 0.0};
  double reprojection_px = 0.0;  ///< RMS over the calibration pictures

  friend bool operator==(const StereoCalibration&, const StereoCalibration&) = default;
};

/// Checks a calibration. kInvalidArgument with the cause: no camera, an invalid rotation, left and right exchanged, no
/// baseline.
[[nodiscard]] Status validate(const StereoCalibration& calibration);

/// Parses the text of an OpenCV YAML file. kParse: the file format is wrong or a field is missing; also the errors of
/// validate().
[[nodiscard]] Result<StereoCalibration> parse_stereo_calibration(std::string_view text);
[[nodiscard]] std::string to_yaml(const StereoCalibration& calibration);
/// The same for files; the errors name the file.
[[nodiscard]] Result<StereoCalibration> read_stereo_calibration(const std::filesystem::path& path);
[[nodiscard]] Status write_stereo_calibration(const std::filesystem::path& path, const StereoCalibration& calibration);

/// Transforms the pictures of two real cameras into those of a StereoGeometry.
class Rectifier {
 public:
  /// Makes a rectifier. kInvalidArgument: the calibration is invalid, or its eyes share no field of view.
  [[nodiscard]] static Result<Rectifier> create(const StereoCalibration& calibration);
  /// A rectifier for pictures that are rectified already: only their size is checked.
  [[nodiscard]] static Result<Rectifier> none(const StereoGeometry& geometry);

  [[nodiscard]] const StereoGeometry& geometry() const { return geometry_; }
  /// The rectified pictures in grey. kInvalidArgument: pictures of another size than calibrated.
  [[nodiscard]] Result<StereoFrame> rectify(RobotTime stamp, const Image& left, const Image& right) const;

 private:
  struct Eye {
    cv::Mat map;
    cv::Mat weights;
  };
  [[nodiscard]] Result<Image> rectify_eye(const char* which, const Eye& eye, const Image& picture) const;

  StereoGeometry geometry_;
  std::array<Eye, 2> eyes_;  ///< empty maps: no rectification
};

}  // namespace seeker::drivers
