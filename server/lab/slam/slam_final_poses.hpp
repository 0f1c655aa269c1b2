/// \file
/// The poses of a whole run as the map says in the end: loops that were closed later move what was driven before.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/line_map.hpp"
#include "common/core/pose2.hpp"
#include "common/core/time.hpp"

namespace seeker::lab {

/// What the estimator said at a scan.
struct OnlinePose {
  RobotTime stamp;
  Pose2 map_T_base;
  std::uint32_t map_epoch = 0;
};

/// Poses at all scans (rising stamps), each carried by the online motion from the kept scans (LineMap::keyframes)
/// before and after it, and blended by time between the two; over a change of the epoch only from the side of the same
/// epoch. Without keyframes the poses stay as they were.
[[nodiscard]] std::vector<Pose2> final_poses(const std::vector<OnlinePose>& online, const LineMap& map);

}  // namespace seeker::lab
