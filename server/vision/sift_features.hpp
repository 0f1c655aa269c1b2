/// \file
/// SIFT key points with byte descriptors: the one detector of recogniser, stereo and places.
#pragma once

#include <opencv2/core.hpp>

#include "server/vision/descriptor.hpp"
#include "server/vision/detector_params.hpp"

namespace seeker::vision {

/// A place whose gradients have several main directions is described once for each of them.
enum class Orientations : std::uint8_t {
  kOne,  ///< the first of them only: one feature a place, so that counts of features are counts of places
  kAll,  ///< all, one after the other: the other picture may have lost the first
};

/// Key points of `grey` (CV_8UC1), the strongest of every cell of the grid first; `params` counts places. OpenCV 4.6's
/// shift of a quarter pixel is taken back (vision.md 1.1). Empty for pictures too small to hold a key point.
[[nodiscard]] FeatureList detect_sift(const cv::Mat& grey, const DetectorParams& params,
                                      Orientations orientations = Orientations::kOne);

/// Whether two key points of one picture are at one place.
[[nodiscard]] bool same_place(const Keypoint& a, const Keypoint& b);

}  // namespace seeker::vision
