/// \file
/// Which contrast threshold gives as many key points as are wanted, without detecting twice.
#pragma once

#include <opencv2/core.hpp>

#include "server/vision/detector_params.hpp"

namespace seeker::vision {

/// The highest of contrast_threshold / 2^k, k = 0..contrast_halvings, for which `grey` (CV_8UC1) promises enough key
/// points; above contrast_threshold where even so there would be several times as many as are kept, since the weak ones
/// cost time. Counted are the extrema, not on edges, of one difference of Gaussians at half resolution: over 20
/// photographs of corridors, rooms and plants there were 0.4 to 1.3, in the middle 0.75, SIFT key points for each. It
/// costs about one hundredth of a detection; detecting twice would cost a whole one.
[[nodiscard]] double pick_contrast_threshold(const cv::Mat& grey, const DetectorParams& params);

}  // namespace seeker::vision
