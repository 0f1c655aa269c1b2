#include "server/vision/picture.hpp"

#include <algorithm>

namespace seeker::vision {

cv::Mat to_grey_mat(const Image& picture) {
  const Image grey = to_grey(picture);
  cv::Mat mat(grey.height_px(), grey.width_px(), CV_8UC1);
  for (int row = 0; row < mat.rows; ++row) {
    std::copy_n(grey.at(0, row), static_cast<std::size_t>(mat.cols), mat.ptr<std::uint8_t>(row));
  }
  return mat;
}

Image to_image(const cv::Mat& mat) {
  SEEKER_ASSERT(mat.type() == CV_8UC1 || mat.type() == CV_8UC3);
  Image image(mat.cols, mat.rows, mat.channels());
  const auto bytes = static_cast<std::size_t>(mat.cols) * static_cast<std::size_t>(mat.channels());
  for (int row = 0; row < mat.rows; ++row) {
    std::copy_n(mat.ptr<std::uint8_t>(row), bytes, image.data().begin() + static_cast<std::ptrdiff_t>(bytes) * row);
  }
  return image;
}

}  // namespace seeker::vision
