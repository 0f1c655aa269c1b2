/// \file
/// Check whether the robot may hold a control for a while: the disc that it sweeps must not touch any obstacle that is
/// mapped or seen now.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "server/explore/segment_sight.hpp"
#include "server/explore/strategy.hpp"

namespace seeker::explore {

/// Holds the obstacles for one decision.
class ControlCheck {
 public:
  /// Collects the walls of the scene, the present readings, the floor map and the forbidden areas. `longest_path_m` is
  /// the longest path of any control that will be checked. Without `use_floor` the floor map is not used.
  ControlCheck(const StrategyInput& input, const SightScene& scene, double radius_m, double longest_path_m,
               bool use_floor = true);

  /// Why the control must not be held for `tau_s`; empty when it may. A robot that is too near to an obstacle may still
  /// move as long as it does not come nearer. Rotation on the spot touches no obstacle.
  [[nodiscard]] std::string refusal(const Twist2& control, double tau_s) const;

 private:
  [[nodiscard]] double distance_m(const Point2& p_map) const;

  Pose2 map_T_base_;
  double radius_m_;
  const nav::ForbiddenAreas& areas_;
  std::shared_ptr<const nav::FloorView> floor_;   ///< null: there is no map of the floor, or it is not used
  std::vector<std::pair<Point2, Point2>> walls_;  ///< walls within reach of the robot
  std::vector<Point2> points_map_;
};

}  // namespace seeker::explore
