/// \file
/// From a picture of turbid water to the one solid in it: even light, contrast, threshold, largest region (spec S6).
/// The solids are convex: what a dim face lacks in the region is filled up to its convex hull.
#pragma once

#include <optional>

#include <opencv2/core.hpp>

namespace seeker::vision {

struct SegmentParams {
  double light_sigma_px = 70.0;  ///< blotches of light larger than this are taken out (homomorphic filter)
  double stretch_low = 0.01;     ///< percentiles of the contrast stretch
  double stretch_high = 0.995;
  double floor_sigmas = 4.0;  ///< a face is brighter than the floor by so many of its sigmas ...
  double face_share = 0.22;   ///< ... and by this share of what the brightest faces are brighter
  double contrast_sigmas =
      5.0;             ///< the brightest faces stand out from the floor by so many of its sigmas, or there is nothing
  int opening_px = 7;  ///< odd
  int closing_px = 9;  ///< odd
  double min_area = 0.004;  ///< of the picture
  double max_area = 0.5;

  friend bool operator==(const SegmentParams&, const SegmentParams&) = default;
};

/// The picture after each step.
struct SolidRegion {
  cv::Mat even;  ///< CV_8U, median filtered, without uneven light, stretched
  cv::Mat mask;  ///< CV_8U, 255 in the solid; convex
  cv::Rect box;
};

/// Nothing where no region is of a solid's size, all touch the border, or the floor is empty. `grey` is CV_8UC1 and not
/// empty.
[[nodiscard]] std::optional<SolidRegion> segment_solid(const cv::Mat& grey, const SegmentParams& params);

}  // namespace seeker::vision
