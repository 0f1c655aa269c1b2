/// \file
/// Whether a scan denies what is known where it was taken.
#pragma once

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "server/slam/reference_cloud.hpp"

namespace seeker::slam {

struct SeenThroughParams {
  double margin_m = 0.25;      ///< a beam that ends so far behind a surface has gone through it
  double grazing_rad = 0.175;  ///< surfaces that a beam meets at a smaller angle say nothing (10 degrees)
};

/// Share of the known points which the scan should show from there - in its range and field of view, facing it - that
/// its beams have gone through. Those that something nearer hides, or whose beam has not come back, are neither. 0
/// where nothing known should be seen: the other face of a pillar denies none of those that were seen before.
[[nodiscard]] double seen_through(const ReferenceCloud& reference, const LaserScan& scan, const Pose2& map_T_base,
                                  const SeenThroughParams& params = {});

}  // namespace seeker::slam
