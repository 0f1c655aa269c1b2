/// \file
/// Choice of the contrast threshold for a wanted number of key points, without a second detection.
#pragma once

#include <opencv2/core.hpp>

#include "server/vision/detector_params.hpp"

namespace seeker::vision {

/// The highest of contrast_threshold / 2^k, k = 0..contrast_halvings, for which `grey` (CV_8UC1) is expected to have
/// enough key points; above contrast_threshold where several times as many as are kept would be found, since the weak
/// ones cost time. The estimate counts the extrema, not on edges, of one difference of Gaussians at half resolution:
/// over 20 photographs of corridors, rooms and plants there were 0.4 to 1.3 SIFT key points for each, with a median of
/// 0.75. It costs about one hundredth of a detection; a second detection would cost a whole one.
[[nodiscard]] double pick_contrast_threshold(const cv::Mat& grey, const DetectorParams& params);

}  // namespace seeker::vision
