/// \file
/// Where the robot has been.
#pragma once

#include <cstddef>
#include <vector>

#include "common/api/robot_state.hpp"
#include "common/core/pose2.hpp"
#include "common/core/time.hpp"

namespace seeker::app {

/// Poses in frame `map`, spaced by distance; memory is bounded by keeping every second pose of the older half.
class Trajectory {
 public:
  Trajectory(double spacing_m, std::size_t max_poses) : spacing_m_(spacing_m), max_poses_(max_poses) {}

  /// Kept when it is at least the spacing away from the pose kept last.
  void add(RobotTime now, const Pose2& map_T_base);
  void clear() { poses_.clear(); }
  [[nodiscard]] const std::vector<api::StampedPose>& stamped() const { return poses_; }
  [[nodiscard]] std::vector<Pose2> poses() const;

 private:
  double spacing_m_;
  std::size_t max_poses_;
  std::vector<api::StampedPose> poses_;
};

}  // namespace seeker::app
