/// \file
/// A look with both eyes: what estimators and missions get of the stereo camera.
#pragma once

#include "common/core/pose_estimate.hpp"
#include "server/vision/stereo_features.hpp"

namespace seeker::app {

struct StereoLook {
  RobotTime stamp;    ///< of the exposure
  PoseEstimate pose;  ///< of the robot then
  Pose2 odom_T_base;  ///< the same by dead reckoning
  vision::StereoFeatures features;
};

}  // namespace seeker::app
