/// \file
/// A trajectory records where the robot has been.
#pragma once

#include <cstddef>
#include <vector>

#include "common/api/robot_state.hpp"
#include "common/core/pose2.hpp"
#include "common/core/time.hpp"

namespace seeker::app {

/// Keeps poses in frame `map`, spaced by distance; beyond `max_poses` every second one of the older half is dropped.
class Trajectory {
 public:
  Trajectory(double spacing_m, std::size_t max_poses) : spacing_m_(spacing_m), max_poses_(max_poses) {}

  /// Adds the pose if it is at least `spacing_m` away from the last one.
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
