/// \file
/// The estimators that seeker-lab runs over logs, by name.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "server/app/composition/robot_options.hpp"
#include "server/slam/pose_tracker.hpp"

namespace seeker::lab {

/// Names as in the field `estimator` of a robot file.
[[nodiscard]] std::vector<std::string> estimator_names();
[[nodiscard]] std::string name_of(app::EstimatorType type);

/// An estimator with the parameters of the robot file, at the origin of `map`. For a slam::MapTracker, segments and
/// loop closures are also reported, and its final poses are smoothed. kNotFound: no such name.
[[nodiscard]] Result<std::unique_ptr<slam::PoseTracker>> make_tracker(const std::string& name,
                                                                      const app::RobotOptions& options);

}  // namespace seeker::lab
