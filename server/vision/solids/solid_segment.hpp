/// \file
/// Segmentation of the one solid in a picture of turbid water: even light, contrast, threshold, largest region (spec
/// S6). The solids are convex: parts of a dim face missing in the region are filled up to its convex hull.
#pragma once

#include <optional>

#include <opencv2/core.hpp>

namespace seeker::vision {

struct SegmentParams {
  double light_sigma_px = 70.0;  ///< variations of the light larger than this are removed (homomorphic filter)
  double stretch_low = 0.01;     ///< percentiles of the contrast stretch
  double stretch_high = 0.995;
  double floor_sigmas = 4.0;     ///< excess of a face over the floor's brightness, in the floor's sigmas ...
  double face_share = 0.22;      ///< ... and as a share of the excess of the brightest faces
  double contrast_sigmas = 5.0;  ///< excess of the brightest faces in the floor's sigmas, below which there is no solid
  int opening_px = 7;            ///< size of the opening, odd
  int closing_px = 9;            ///< size of the closing, odd
  double min_area = 0.004;       ///< share of the picture
  double max_area = 0.5;

  friend bool operator==(const SegmentParams&, const SegmentParams&) = default;
};

/// Results of the steps.
struct SolidRegion {
  cv::Mat even;  ///< CV_8U, median filtered, without uneven light, stretched
  cv::Mat mask;  ///< CV_8U, 255 in the solid; convex
  cv::Rect box;
};

/// Segments the solid. No value where no region has a solid's size, all touch the border, or the floor is empty. `grey`
/// is CV_8UC1 and not empty.
[[nodiscard]] std::optional<SolidRegion> segment_solid(const cv::Mat& grey, const SegmentParams& params);

}  // namespace seeker::vision
