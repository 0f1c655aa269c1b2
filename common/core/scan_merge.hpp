/// \file
/// One scan out of those of several scanners on one robot.
#pragma once

#include <functional>
#include <span>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"

namespace seeker {

struct ScanMergeParams {
  double angle_step_rad = 0.00872664625997164788;  ///< grid of the merged scan: 0.5 degrees
  double surface_step = 0.05;  ///< neighbouring returns of one scanner are one surface, and the grid is filled between
                               ///< them, where their ranges differ by less than this share of the nearer one
  double largest_gap_rad = 0.0524;  ///< and where they are seen from the base within this angle, 3 degrees
};

/// The first scan's moment as all the scanners saw it, from the origin of the base: a full circle of beams from -pi on
/// with the frame `laser` equal to `base`, no sweep, and the stamp of the first scan. Of returns in one direction the
/// nearest counts, whichever scanner saw it. A direction in which no scanner looked is unusable (quality 0); one in
/// which a scanner had no return has none here. `odom_T_base_at` gives the pose of the base in any fixed frame, by
/// which its motion between the scans and within their sweeps is taken out. At least one scan; all valid.
[[nodiscard]] LaserScan merged_scan(std::span<const LaserScan> scans,
                                    const std::function<Pose2(RobotTime)>& odom_T_base_at,
                                    const ScanMergeParams& params = {});

}  // namespace seeker
