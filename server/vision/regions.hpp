/// \file
/// Stage 2 of spec S3.4: growing of 8-connected regions.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace seeker::vision {

/// A connected region of one class.
struct Region {
  cv::Rect box;
  int area_px = 0;  ///< number of its pixels
  bool light = false;

  friend bool operator==(const Region&, const Region&) = default;
};

/// All 8-connected regions of the dark and the light class (binarise.hpp) in the order of their first pixel. One pass
/// over runs of equal pixels with union-find, both classes at once.
[[nodiscard]] std::vector<Region> grow_regions(const cv::Mat& classes);

}  // namespace seeker::vision
