/// \file
/// Acceptance test of the feature recogniser: matches must agree on one plausible homography.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "server/vision/recogniser_params.hpp"

namespace seeker::vision {

/// Position of a target in the scene.
struct PlanarFit {
  cv::Matx33d scene_T_target;          ///< homography, target pixels to scene pixels
  std::array<cv::Point2d, 4> corners;  ///< corners of the target's picture in the scene: top left, top right, ...
  std::vector<std::size_t> inliers;    ///< indices of the pairs that agree, recounted with the final model
};

/// Fits by RANSAC, recomputes the residuals (the library's mask is that of an earlier model, vision.md 1.4), refits to
/// the inliers and recounts. No value without a model, with too few inliers, or when the outline is not a convex,
/// unmirrored quadrilateral of plausible size. Pairs: target_points[i] matches scene_points[i], one to one.
[[nodiscard]] std::optional<PlanarFit> fit_planar(const std::vector<cv::Point2f>& target_points,
                                                  const std::vector<cv::Point2f>& scene_points,
                                                  const cv::Size& target_size, const FeatureParams& params);

}  // namespace seeker::vision
