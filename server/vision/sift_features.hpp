/// \file
/// SIFT key points as the feature recogniser needs them.
#pragma once

#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "server/vision/recogniser_params.hpp"

namespace seeker::vision {

/// Key points with their descriptors, row i belonging to point i (CV_32F, 128 columns).
struct SiftFeatures {
  std::vector<cv::Point2f> points;
  cv::Mat descriptors;
};

/// Detects with a contrast threshold that is halved up to twice while fewer than wanted_features are found, takes back
/// OpenCV 4.6's shift of a quarter pixel, and keeps one descriptor per place (of several orientations the first).
[[nodiscard]] SiftFeatures detect_sift(const cv::Mat& grey, const FeatureParams& params);

/// A pair of rows of two descriptor lists.
struct FeatureMatch {
  int target = 0;
  int scene = 0;
};

/// Mutual best matches whose distance is below `ratio` times that of the second best, either way.
[[nodiscard]] std::vector<FeatureMatch> match_mutually(const SiftFeatures& target, const SiftFeatures& scene,
                                                       double ratio);

}  // namespace seeker::vision
