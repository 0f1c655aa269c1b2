/// \file
/// Figures of explorations.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/core/image.hpp"
#include "server/lab/active_slam/explore_run.hpp"

namespace seeker::lab {

/// Figs 4 and 5 of the active-SLAM paper: the mapped segments laid on the true walls, what is missing, and the true
/// path, dash-dotted where the robot followed a wall.
[[nodiscard]] Image draw_exploration(const ExploreRecord& record, const std::string& title);

/// Fig 6: localisation error over time.
[[nodiscard]] Image error_figure(const std::string& title, const std::vector<NamedCurve>& curves);
/// Fig 7: trace of the covariance over time: of robot and segments together, of the robot alone, and the mean over
/// segments.
[[nodiscard]] Image trace_figure(const std::string& title, const std::vector<NamedCurve>& curves);
/// Area of known floor over the path.
[[nodiscard]] Image floor_figure(const std::string& title, const std::vector<NamedCurve>& curves);

}  // namespace seeker::lab
