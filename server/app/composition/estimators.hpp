/// \file
/// The estimators a robot file may name.
#pragma once

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "server/app/composition/robot_options.hpp"
#include "server/app/estimators/estimator.hpp"
#include "server/app/landmarks/landmark_library.hpp"
#include "server/app/runtime/devices.hpp"
#include "server/slam/pose_tracker.hpp"

namespace seeker::app {

/// Names as in the field `estimator` of a robot file.
[[nodiscard]] const std::vector<std::pair<std::string_view, EstimatorType>>& estimator_names();
[[nodiscard]] std::string_view to_string(EstimatorType type);

/// Whether it goes by wheels and walls alone: make_tracker() makes it.
[[nodiscard]] bool is_tracker(EstimatorType type);
/// A tracker with the parameters of the robot file, at the origin of `map`. Asserts is_tracker().
[[nodiscard]] std::unique_ptr<slam::PoseTracker> make_tracker(EstimatorType type, const RobotOptions& options);

/// The database of landmarks that the estimator goes by; empty: it goes by none.
[[nodiscard]] std::string database_in_use(const RobotOptions& options);

/// The estimator that the robot file names, whichever it is. Errors name the field that is wrong, or the database of
/// landmarks in `library` that cannot be used.
[[nodiscard]] Result<std::unique_ptr<Estimator>> make_estimator(const RobotOptions& options, const Devices& devices,
                                                                const std::shared_ptr<LandmarkLibrary>& library);

}  // namespace seeker::app
