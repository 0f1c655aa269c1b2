/// \file
/// Drawing of the stages (Fig 4 of the search paper).
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "server/vision/regions.hpp"
#include "server/vision/sighting.hpp"

namespace seeker::vision {

/// The grey picture with a box around every region: dark ones blue, light ones orange.
[[nodiscard]] Image draw_regions(const cv::Mat& grey, const std::vector<Region>& regions);

/// The grey picture with a dot at every key point.
[[nodiscard]] Image draw_points(const cv::Mat& grey, const std::vector<cv::Point2f>& points);

/// The picture with a green box and a cross at the centre of every sighting.
[[nodiscard]] Image draw_sightings(const Image& picture, const std::vector<Sighting>& sightings);

}  // namespace seeker::vision
