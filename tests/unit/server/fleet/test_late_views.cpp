// Robots that receive each other's goals late may choose one goal; they must not both drive on to it.

#include <gtest/gtest.h>

#include "server/fleet/topological_strategy.hpp"
#include "tests/unit/server/explore/toy_worlds.hpp"

namespace seeker::fleet {
namespace {

using explore::Exploration;
using explore::ExploreInput;
using explore::ToyExplorer;

constexpr double kLimit_s = 60.0;

/// Another robot is found to drive to the goal that robot "m" has chosen: after how long does "m" leave it?
double leaves_its_goal_after_s(const std::string& other_id) {
  explore::ExploreRequest request;
  request.strategy = [](const explore::ExploreParams& params) {
    return std::make_unique<TopologicalStrategy>(params, TopologicalParams{});
  };
  Exploration exploration = std::move(*Exploration::create(request, {}));
  FleetView fleet{"m", {}, nullptr};
  fleet.others.emplace_back();
  RobotTopology& other = fleet.others.front();
  other.robot_id = other_id;
  other.map_T_base = {8.5, 4.0, 0.0};
  other.active = false;
  std::optional<double> heard_s;
  std::optional<double> left_s;
  ToyExplorer::Hooks hooks;
  hooks.exploration = [&](double t_s, Exploration& now) {
    const std::optional<Point2> target_map = now.strategy().target_map();
    if (!heard_s && target_map) {
      heard_s = t_s;
      other.active = true;
      other.target_map = target_map;
    } else if (heard_s && !left_s && target_map != other.target_map) {
      left_s = t_s;
    }
  };
  hooks.input = [&](double, ExploreInput& input) { input.fleet = &fleet; };
  ToyExplorer robot(explore::two_rooms(), {1.0, 1.0, 0.3}, 7, 6.0);
  (void)robot.run(exploration, kLimit_s, hooks);
  EXPECT_TRUE(heard_s);
  return left_s.value_or(kLimit_s) - heard_s.value_or(0.0);
}

TEST(LateViews, OfTwoRobotsWithOneGoalTheOneWithTheHigherIdChoosesAgainAtOnce) {
  const double soon_s = TopologicalParams{}.replan_period_s + 0.5;
  EXPECT_LT(leaves_its_goal_after_s("a"), soon_s);
  EXPECT_GT(leaves_its_goal_after_s("z"), soon_s);
}

}  // namespace
}  // namespace seeker::fleet
