/// \file
/// Checks whether a scan contradicts known surfaces, since its beams pass through them.
#pragma once

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "server/slam/reference_cloud.hpp"

namespace seeker::slam {

struct SeenThroughParams {
  double margin_m = 0.25;      ///< a beam that ends this far behind a surface has passed through it
  double grazing_rad = 0.175;  ///< surfaces at a smaller angle to the beam are not evaluated (10 degrees)
};

/// Share of the known points visible from the pose (in the scan's range and field of view, and facing it) that the
/// scan's beams have passed through. Points that are occluded by something nearer, or whose beam has no return, do not
/// count. 0 where no known point should be visible: the other face of a pillar does not contradict any point that was
/// observed before.
[[nodiscard]] double seen_through(const ReferenceCloud& reference, const LaserScan& scan, const Pose2& map_T_base,
                                  const SeenThroughParams& params = {});

}  // namespace seeker::slam
