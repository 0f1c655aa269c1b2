/// \file
/// Drives to a point by the means of the strategy: planned paths, or the local planner and a bearing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/nav/planned_driver.hpp"
#include "server/nav/progress_watch.hpp"
#include "server/search/local_planner.hpp"
#include "server/search/search_params.hpp"
#include "server/search/strategy.hpp"

namespace seeker::search {

/// The drive used for confirming and approaching. The robot has arrived within `tolerance_m` (local planner) or at the
/// end of the path.
class DriveTo {
 public:
  DriveTo(const SearchParams& params, LocalPlanner planner, bool use_map);

  /// Starts a drive; false when no path is known.
  bool start(const StrategyInput& input, const Point2& goal_map, double tolerance_m);
  [[nodiscard]] nav::DriveStep step(const StrategyInput& input);
  void stop();
  [[nodiscard]] std::vector<Point2> path(const Pose2& map_T_base) const;
  [[nodiscard]] bool uses_map() const { return use_map_; }

 private:
  [[nodiscard]] nav::DriveStep step_locally(const StrategyInput& input);

  PaperParams paper_;
  LocalPlanner planner_;
  nav::PlannedDriver driver_;
  bool use_map_;
  bool active_ = false;
  Point2 goal_ = Point2::Zero();
  double tolerance_m_ = 0.1;
  nav::ProgressWatch progress_;
};

}  // namespace seeker::search
