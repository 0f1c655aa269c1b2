/// \file
/// The picture of one laser scan with the straight lines in it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"

namespace seeker::image {

/// What the picture shows, in the frame `laser`.
struct ScanScene {
  std::string title;                             ///< first row of the legend
  std::vector<Point2> points;                    ///< returns of the scan
  std::vector<std::pair<Point2, Point2>> lines;  ///< start and end of each line
};

/// Draws the points, the lines with their ends, and the sensor. kNotReady: there are no points; kTooLarge: beyond 5 km.
[[nodiscard]] Result<Image> draw_scan(const ScanScene& scene);
/// draw_scan() as an SVG document.
[[nodiscard]] Result<std::string> scan_svg(const ScanScene& scene);

}  // namespace seeker::image
