/// \file
/// One segment for each piece of wall, where several local maps have seen it.
#pragma once

#include <vector>

#include "common/core/line_map.hpp"

namespace seeker::slam {

struct FusionParams {
  double max_offset_m = 0.12;   ///< two pictures of one wall are not farther apart across it
  double max_angle_rad = 0.12;  ///< nor turned by more than this
  double max_gap_m = 0.2;       ///< nor have a wider gap between their ends, which must not both be real: a doorway
};

/// Puts together what is the same wall: same side, same line, overlapping or touching. The result keeps the smallest
/// id of each group, the outermost ends, the sum of hits; place and direction are the mean weighted by what was seen
/// (length times hits), the covariance is that of the best member. Segments in the frame `map`; the order of the
/// result is that of the ids. O(n) in the size of the building.
[[nodiscard]] std::vector<MapSegment> fuse(std::vector<MapSegment> segments, const FusionParams& params = {});

}  // namespace seeker::slam
