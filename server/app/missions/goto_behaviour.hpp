/// \file
/// Missions `goto` and `return`: visits places one after the other along planned paths.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/app/maps/segment_view.hpp"
#include "server/app/missions/behaviour.hpp"
#include "server/app/missions/full_rotation.hpp"
#include "server/nav/cost_map.hpp"
#include "server/nav/floor_view.hpp"
#include "server/nav/path_follower.hpp"
#include "server/nav/planner.hpp"
#include "server/nav/retry_drive.hpp"
#include "server/nav/sonar_obstacles.hpp"

namespace seeker::app {

struct GotoParams {
  nav::CostMapParams cost_map{.unknown_traversable = true};  ///< a goal may lie where nobody has been
  nav::PlannerParams planner;
  nav::FollowerParams follower;
  Duration replan_period = std::chrono::seconds(2);  ///< the map grows while driving
  int max_failures = 5;    ///< paths found blocked without progress before an attempt has failed
  nav::RetryParams retry;  ///< attempts before a place is given up, since people who block a path move on
};

class GotoBehaviour final : public Behaviour {
 public:
  /// `bound`: the robot stays inside. The first `leading` waypoints only lead the robot: one to which no path is known
  /// is left out at once and reported by nobody.
  GotoBehaviour(const GotoParams& params, api::GotoMission mission, std::optional<Polygon> bound = std::nullopt,
                std::size_t leading = 0);

  [[nodiscard]] Decision step(const Situation& situation) override;
  void resumed(RobotTime now) override;
  /// Places stay where they were asked for, in the frame `map`; the path to them is planned again.
  void map_moved(const MapMove& move) override;

 private:
  void next_waypoint(Decision& decision);
  void drive(const Situation& situation, const nav::DriveInput& input, Decision& decision);
  /// There is no path now: the robot rotates once where the floor around it has not been observed, waits, or gives the
  /// place up. `over` says that all attempts have failed.
  void cannot_drive(const Situation& situation, const nav::DriveFailure& why, bool over, Decision& decision);
  /// Returns a cause that no waiting will change: the place lies in a kept-out area, in a mapped wall, where the map
  /// ends.
  [[nodiscard]] std::optional<UnreachableCause> lasting_cause(const Situation& situation, const Point2& goal_map,
                                                              UnreachableCause cause);
  [[nodiscard]] bool look_helps(const Situation& situation, UnreachableCause cause) const;
  void look_round(const Situation& situation, Decision& decision);
  /// Whether a path would lead to the place if nothing was forbidden.
  [[nodiscard]] bool areas_cut_off(const Point2& goal_map) const;
  void give_up(const nav::DriveFailure& why, Decision& decision);

  api::GotoMission mission_;
  nav::FloorSource floors_;
  nav::SonarObstacles sonar_obstacles_;
  SegmentView segments_;
  double robot_radius_m_;
  nav::RetryDrive drive_;
  std::size_t leading_;
  std::size_t current_ = 0;
  bool driving_ = false;  ///< to the current place
  bool map_seen_ = false;
  FullRotation rotation_;
  bool looked_round_ = false;  ///< since the last place was reached
  std::vector<UnreachablePlace> unreachable_;
};

}  // namespace seeker::app
