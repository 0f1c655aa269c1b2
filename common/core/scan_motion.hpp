/// \file
/// Scans of a scanner that moves while it measures.
#pragma once

#include <functional>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"

namespace seeker {

/// The scan as it would have been measured all at once at its stamp: each end point is moved by the motion of the base
/// between the moment of its beam and the stamp, and put back onto the grid of beams; `sweep` is zero then. A beam of
/// the result has the value of the moved beam nearest to it, at most one step away; where there is none it is
/// kNoReturn. Beams without a return are turned only. `odom_T_base_at` gives the pose of the base in any fixed frame.
/// A scan whose sweep is zero is returned as it is.
[[nodiscard]] LaserScan corrected_for_motion(const LaserScan& scan,
                                             const std::function<Pose2(RobotTime)>& odom_T_base_at);

}  // namespace seeker
