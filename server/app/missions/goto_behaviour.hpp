/// \file
/// Missions `goto` and `return`: visits places one after the other along planned paths.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/app/maps/segment_view.hpp"
#include "server/app/missions/behaviour.hpp"
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
  int max_failures = 5;    ///< ways that turned out blocked, without getting nearer, before an attempt has failed
  nav::RetryParams retry;  ///< attempts before a place is given up: people in the way move on
};

class GotoBehaviour final : public Behaviour {
 public:
  /// `bound`: the robot stays inside.
  GotoBehaviour(const GotoParams& params, api::GotoMission mission, std::optional<Polygon> bound = std::nullopt);

  [[nodiscard]] Decision step(const Situation& situation) override;
  void resumed(RobotTime now) override;
  /// Places stay where they were asked for, in the frame `map`; the way there is planned anew.
  void map_moved(const MapMove& move) override;

 private:
  void next_waypoint(Decision& decision);
  void drive(const Situation& situation, const nav::DriveInput& input, Decision& decision);
  /// Whether what the place lies in will never go away: a kept-out area, a mapped wall.
  [[nodiscard]] bool stays_blocked(const Situation& situation, const Point2& goal_map);
  void give_up(const std::string& why, Decision& decision);

  api::GotoMission mission_;
  nav::FloorSource floors_;
  nav::SonarObstacles sonar_obstacles_;
  SegmentView segments_;
  nav::RetryDrive drive_;
  std::size_t current_ = 0;
  bool under_way_ = false;  ///< to the current place
  bool map_seen_ = false;
  std::vector<Point2> unreachable_;
};

}  // namespace seeker::app
