/// \file
/// SIFT key points with byte descriptors: the detector that recogniser, stereo and place recognition share.
#pragma once

#include <opencv2/core.hpp>

#include "server/vision/descriptor.hpp"
#include "server/vision/detector_params.hpp"

namespace seeker::vision {

/// Number of features at a position whose gradients have several main directions.
enum class Orientations : std::uint8_t {
  kOne,  ///< only the first direction: one feature per position, so that counts of features are counts of positions
  kAll,  ///< all directions, one after the other, since the other picture may not show the first
};

/// Key points of `grey` (CV_8UC1), the strongest of every cell of the grid first; `params` counts positions. The shift
/// by a quarter pixel of OpenCV 4.6 is corrected (vision.md 1.1). Empty for pictures too small for a key point.
[[nodiscard]] FeatureList detect_sift(const cv::Mat& grey, const DetectorParams& params,
                                      Orientations orientations = Orientations::kOne);

/// Whether two key points of one picture have the same position.
[[nodiscard]] bool same_place(const Keypoint& a, const Keypoint& b);

}  // namespace seeker::vision
