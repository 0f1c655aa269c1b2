/// \file
/// Fusion of the segments of one wall that were observed in several local maps.
#pragma once

#include <vector>

#include "common/core/line_map.hpp"

namespace seeker::slam {

struct FusionParams {
  double max_offset_m = 0.12;   ///< largest offset between two observations of one wall, across it
  double max_angle_rad = 0.12;  ///< largest angle between them
  double max_gap_m = 0.2;       ///< largest gap between their ends; a wider one between real ends is a doorway
};

/// Joins the segments that are the same wall: same side, same line, overlapping or touching. The result keeps the
/// smallest id of each group, the outermost ends and the sum of hits; position and direction are the mean weighted by
/// length times hits, the covariance is that of the best member. Segments are in the frame `map`; the order of the
/// result is that of the ids. O(n) in the size of the building.
[[nodiscard]] std::vector<MapSegment> fuse(std::vector<MapSegment> segments, const FusionParams& params = {});

}  // namespace seeker::slam
