#include "server/app/loop/trajectory.hpp"

#include <utility>

namespace seeker::app {

void Trajectory::add(RobotTime now, const Pose2& map_T_base) {
  if (poses_.empty() || distance_m(poses_.back().map_T_base, map_T_base) >= spacing_m_) {
    poses_.push_back({now, map_T_base});
  }
  if (poses_.size() > max_poses_) {
    std::vector<api::StampedPose> thinned;
    const std::size_t half = poses_.size() / 2;
    for (std::size_t i = 0; i < poses_.size(); i += i < half ? 2 : 1) {
      thinned.push_back(poses_[i]);
    }
    poses_ = std::move(thinned);
  }
}

std::vector<Pose2> Trajectory::poses() const {
  std::vector<Pose2> poses;
  poses.reserve(poses_.size());
  for (const api::StampedPose& pose : poses_) {
    poses.push_back(pose.map_T_base);
  }
  return poses;
}

}  // namespace seeker::app
