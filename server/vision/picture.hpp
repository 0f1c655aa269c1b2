/// \file
/// Conversion between seeker::Image and OpenCV's matrices. Only the .cpp files of the vision folder include it.
#pragma once

#include <opencv2/core.hpp>

#include "common/core/image.hpp"

namespace seeker::vision {

/// A one-channel copy (ITU-R BT.601 for colour).
[[nodiscard]] cv::Mat to_grey_mat(const Image& picture);
/// Copies CV_8UC1 or CV_8UC3 (red, green, blue) into an Image.
[[nodiscard]] Image to_image(const cv::Mat& mat);

}  // namespace seeker::vision
