/// \file
/// The poses of a whole run according to the final map: later loop closures correct poses that were driven before.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/line_map.hpp"
#include "common/core/pose2.hpp"
#include "common/core/time.hpp"

namespace seeker::lab {

/// Estimate at one scan.
struct OnlinePose {
  RobotTime stamp;
  Pose2 map_T_base;
  std::uint32_t map_epoch = 0;
};

/// Poses at all scans (rising stamps), each computed by the online motion from the keyframes (LineMap::keyframes)
/// before and after it, and blended by time between the two; where the epoch changes in between, only from the keyframe
/// of the same epoch. Without keyframes the poses stay unchanged.
[[nodiscard]] std::vector<Pose2> final_poses(const std::vector<OnlinePose>& online, const LineMap& map);

}  // namespace seeker::lab
