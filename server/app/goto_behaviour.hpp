/// \file
/// Missions `goto` and `return`: visits places one after the other along planned paths.
#pragma once

#include <optional>
#include <vector>

#include "server/app/behaviour.hpp"
#include "server/nav/cost_map.hpp"
#include "server/nav/path_follower.hpp"
#include "server/nav/planner.hpp"

namespace seeker::app {

struct GotoParams {
  nav::CostMapParams cost_map{.unknown_traversable = true};  ///< a goal may lie where nobody has been
  nav::PlannerParams planner;
  nav::FollowerParams follower;
  Duration replan_period = std::chrono::seconds(2);  ///< the map grows while driving
  int max_failures = 5;                              ///< plans in a row without progress before a place is given up
};

class GotoBehaviour final : public Behaviour {
 public:
  /// `bound`: the robot stays inside.
  GotoBehaviour(const GotoParams& params, api::GotoMission mission, std::optional<Polygon> bound = std::nullopt);

  [[nodiscard]] Decision step(const Situation& situation) override;
  void resumed(RobotTime now) override;
  /// Places stay where they were asked for, in the frame `map`; the way there is planned anew.
  void map_moved(const Pose2& new_T_old) override;

 private:
  void next_waypoint(Decision& decision);
  [[nodiscard]] bool plan(const Situation& situation, Decision& decision);
  void give_up(const std::string& why, Decision& decision);

  GotoParams params_;
  api::GotoMission mission_;
  std::optional<Polygon> bound_;
  nav::PathFollower follower_;
  std::size_t current_ = 0;
  int failures_ = 0;
  std::optional<RobotTime> planned_at_;
  std::vector<Point2> unreachable_;
};

}  // namespace seeker::app
