/// \file
/// Disparity to a fraction of a pixel by correlation around a match.
#pragma once

#include <optional>

#include <opencv2/core.hpp>

namespace seeker::vision {

struct RefinedDisparity {
  double disparity_px = 0.0;
  double correlation = 0.0;  ///< zero-mean correlation, -1..1, of the windows at the nearest whole pixel
};

/// Correlates the 11x11 pixels around (u_px, v_px) of `left` with those of `right` up to two pixels left and right of
/// the position given by `disparity_px`, and fits a parabola through the best and its neighbours. Both are CV_8UC1 at
/// full resolution. No value where a window leaves its picture or has no contrast, or the best is at the border of the
/// search.
[[nodiscard]] std::optional<RefinedDisparity> refine_disparity(const cv::Mat& left, const cv::Mat& right, double u_px,
                                                               double v_px, double disparity_px);

}  // namespace seeker::vision
