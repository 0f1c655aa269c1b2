#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "server/fleet/topological_strategy.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/explore/toy_worlds.hpp"

namespace seeker::fleet {
namespace {

using explore::EndKind;
using explore::Exploration;
using explore::ExploreInput;
using explore::ToyExplorer;
using explore::ToyRun;
using seeker::testing::ToyWorld;

/// The rules take ground within 2 m of a node for explored: the backs of desks are not looked for.
constexpr double kWallShare = 0.80;

explore::StrategyMaker topological(const TopologicalParams& topological = {}) {
  return [topological](const explore::ExploreParams& params) {
    return std::make_unique<TopologicalStrategy>(params, topological);
  };
}

Exploration exploration_of(const explore::ExploreParams& params = {}) {
  explore::ExploreRequest request;
  request.strategy = topological();
  auto exploration = Exploration::create(request, params);
  EXPECT_TRUE(exploration.has_value());
  return std::move(*exploration);
}

void print(const char* name, const ToyRun& run, const Topology& topology) {
  std::cout << name << ": " << (run.end ? run.end->cause : "no end") << "; " << run.path_m << " m, " << run.seconds
            << " s, walls " << run.wall_share << ", clearance " << run.least_clearance_m << ", " << run.decisions.size()
            << " decisions, " << topology.nodes.size() << " nodes\n";
}

std::size_t goals_of(const Topology& topology) {
  std::size_t goals = 0;
  for (const TopologyNode& node : topology.nodes) {
    goals += node.goals.size();
  }
  return goals;
}

TEST(TopologicalStrategy, MapsAnOfficeAndEnds) {
  Exploration exploration = exploration_of();
  ToyExplorer robot(explore::office(), {9.0, 5.0, 1.5}, 5, 6.0);
  const ToyRun run = robot.run(exploration, 1500.0);
  const Topology& topology = *exploration.strategy().topology();
  print("office", run, topology);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_GT(run.wall_share, kWallShare);
  EXPECT_GT(run.least_clearance_m, 0.25);
  EXPECT_LT(run.path_m, 160.0);
  EXPECT_EQ(goals_of(topology), 0U);
  EXPECT_GT(topology.nodes.size(), 8U);
}

TEST(TopologicalStrategy, MapsARingAndEnds) {
  Exploration exploration = exploration_of();
  ToyExplorer robot(explore::ring(), {1.0, 1.0, 0.0}, 6, 6.0);
  const ToyRun run = robot.run(exploration, 1500.0);
  print("ring", run, *exploration.strategy().topology());
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_GT(run.wall_share, kWallShare);
  EXPECT_GT(run.least_clearance_m, 0.25);
}

TEST(TopologicalStrategy, GoesBackAlongTheNodesToWhatItLeft) {
  Exploration exploration = exploration_of();
  ToyExplorer robot(explore::office(), {1.0, 5.0, 0.0}, 7, 6.0);
  const ToyRun run = robot.run(exploration, 1500.0);
  EXPECT_TRUE(std::any_of(run.decisions.begin(), run.decisions.end(), [](const ExploreDecision& decision) {
    return decision.why == "back to the closest node with a goal";
  }));
  for (const ExploreDecision& decision : run.decisions) {
    EXPECT_EQ(decision.rule, "topological");
    EXPECT_EQ(decision.chosen.has_value(), !decision.candidates.empty()) << decision.why;
  }
}

TEST(TopologicalStrategy, LeavesGroundWithoutWallsInSightByStages) {
  ToyWorld hall;
  hall.walls = seeker::testing::box(0, 0, 16, 14);
  Exploration exploration = exploration_of();
  ToyExplorer robot(hall, {8.0, 7.0, 0.0}, 3, 5.0);
  const ToyRun run = robot.run(exploration, 1500.0);
  print("hall", run, *exploration.strategy().topology());
  ASSERT_TRUE(run.end.has_value());
  EXPECT_GT(run.wall_share, 0.95);
}

TEST(TopologicalStrategy, DoesTheSameAgain) {
  std::vector<double> paths;
  for (int k = 0; k < 2; ++k) {
    Exploration exploration = exploration_of();
    ToyExplorer robot(explore::two_rooms(), {1.0, 1.0, 0.3}, 7, 6.0);
    paths.push_back(robot.run(exploration, 900.0).path_m);
  }
  EXPECT_EQ(paths[0], paths[1]);
}

TEST(TopologicalStrategy, StaysOutOfTheOtherRoomWhenAnotherRobotIsThere) {
  FleetView fleet{"b", {}, nullptr};
  RobotTopology other;
  other.robot_id = "a";
  other.map_T_base = {7.5, 2.5, 0.0};
  TopologyNode node;
  node.id = 1;
  node.map_T_base = other.map_T_base;
  node.sectors = {{Point2::Zero(), -kPi, kTwoPi, 2.3}};
  other.topology.nodes = {node};
  for (const Point2& p : {Point2(6.2, 1.0), Point2(6.2, 4.0), Point2(9.0, 1.0), Point2(9.0, 4.0)}) {
    TopologyNode more = node;
    more.id = other.topology.nodes.size() + 1;
    more.map_T_base = {p.x(), p.y(), 0.0};
    more.sectors.front().radius_m = 1.2;
    other.topology.nodes.push_back(more);
  }
  other.topology.current = 1;
  fleet.others = {other};
  std::vector<double> farthest_x_m;
  for (const bool alone : {true, false}) {
    Exploration exploration = exploration_of();
    ToyExplorer robot(explore::two_rooms(), {1.0, 1.0, 0.3}, 7, 6.0);
    double x_m = 0.0;
    ToyExplorer::Hooks hooks;
    hooks.input = [&](double, ExploreInput& input) {
      x_m = std::max(x_m, input.pose.map_T_base.x_m);
      input.fleet = alone ? nullptr : &fleet;
    };
    ASSERT_TRUE(robot.run(exploration, 900.0, hooks).end.has_value());
    farthest_x_m.push_back(x_m);
  }
  EXPECT_GT(farthest_x_m[0], 5.8);
  EXPECT_LT(farthest_x_m[1], 5.5);
}

RobotTopology other_in_the_far_corner() {
  RobotTopology other;
  other.robot_id = "a";
  other.map_T_base = {9.0, 4.0, 0.0};
  return other;
}

/// In two rooms, while another robot goes on to say the same.
ToyRun run_beside(const RobotTopology& other, const char* name) {
  FleetView fleet{"b", {other}, nullptr};
  Exploration exploration = exploration_of();
  ToyExplorer robot(explore::two_rooms(), {1.0, 1.0, 0.3}, 7, 6.0);
  ToyExplorer::Hooks hooks;
  hooks.input = [&](double, ExploreInput& input) { input.fleet = &fleet; };
  const ToyRun run = robot.run(exploration, 900.0, hooks);
  print(name, run, *exploration.strategy().topology());
  return run;
}

TEST(TopologicalStrategy, EndsWhenAnotherRobotGoesOnOfferingAGoalThatItSawTo) {
  RobotTopology other = other_in_the_far_corner();
  other.active = false;  // it has ended without having been there
  TopologyNode node;
  node.id = 1;
  node.map_T_base = {3.0, 2.0, 0.0};
  node.goals = {{1, {3.0, 3.5}, 1}};
  TopologyNode far = node;
  far.id = 2;
  far.map_T_base = other.map_T_base;
  far.goals.clear();
  other.topology.nodes = {node, far};
  other.topology.current = far.id;
  const ToyRun run = run_beside(other, "offered goal");
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
}

TEST(TopologicalStrategy, TakesAfterAWhileWhatARobotThatStandsIsNearerTo) {
  RobotTopology other = other_in_the_far_corner();
  other.active = true;
  const ToyRun run = run_beside(other, "idle other");
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_GT(run.wall_share, kWallShare);
}

TEST(TopologicalStrategy, LooksAboutBeforeItWaitsForOthers) {
  RobotTopology other;
  other.robot_id = "a";
  other.map_T_base = {5.6, 2.5, 0.0};
  other.active = true;
  other.target_map = Point2(6.0, 2.5);
  FleetView fleet{"b", {other}, nullptr};
  Exploration exploration = exploration_of();
  ToyExplorer robot(explore::two_rooms(), {1.0, 1.0, 0.3}, 7, 6.0);
  ToyExplorer::Hooks hooks;
  hooks.input = [&](double t_s, ExploreInput& input) {
    fleet.others.front().active = t_s < 300.0;
    input.fleet = &fleet;
  };
  const ToyRun run = robot.run(exploration, 900.0, hooks);
  print("looks about", run, *exploration.strategy().topology());
  ASSERT_TRUE(run.end.has_value());
  const auto waits = std::find(run.phases.begin(), run.phases.end(), "wait");
  ASSERT_NE(waits, run.phases.end());
  EXPECT_EQ(*std::prev(waits), "turn");
}

TEST(TopologicalStrategy, DrivesUpToOneInTheDoorThatYields) {
  Exploration exploration = exploration_of();
  ToyExplorer robot(explore::two_rooms(), {3.3, 2.5, 0.0}, 7, 6.0);
  ToyExplorer::Hooks hooks;
  hooks.input = [](double, ExploreInput& input) {
    nav::Mover other;
    other.frame_T_base = {5.1, 2.5, 0.0};
    if (distance_m(input.pose.map_T_base, other.frame_T_base) > 1.0) {
      input.movers = {other};
    }
  };
  const ToyRun run = robot.run(exploration, 900.0, hooks);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete) << run.end->cause;
  EXPECT_GT(run.wall_share, kWallShare);
}

constexpr Pose2 kBehindTheDoor{7.0, 2.0, 0.0};

/// While an obstacle stands in the only door, and another robot in the room behind. `later` may change what is
/// received.
explore::ExploreEnd end_with_another_behind_the_door(
    bool active, const std::function<void(double t_s, RobotTopology& other)>& later = nullptr) {
  RobotTopology other;
  other.robot_id = "a";
  other.map_T_base = kBehindTheDoor;
  other.active = active;
  FleetView fleet{"b", {other}, nullptr};
  Exploration exploration = exploration_of();
  ToyExplorer robot(explore::two_rooms(), {3.3, 2.5, 0.0}, 7, 6.0);
  ToyExplorer::Hooks hooks;
  hooks.input = [&](double t_s, ExploreInput& input) {
    nav::Mover mover;
    mover.frame_T_base = {5.1, 2.5, 0.0};
    input.movers = {mover};
    if (later) {
      later(t_s, fleet.others.front());
    }
    input.fleet = &fleet;
  };
  const ToyRun run = robot.run(exploration, 900.0, hooks);
  print("behind the door", run, *exploration.strategy().topology());
  EXPECT_TRUE(run.end.has_value());
  return run.end.value_or(explore::ExploreEnd{});
}

TEST(TopologicalStrategy, LeavesAGoalThatItCannotReachToARobotThatExploresThere) {
  EXPECT_EQ(end_with_another_behind_the_door(true).kind, EndKind::kComplete);
}

TEST(TopologicalStrategy, AGoalBesideARobotThatHasEndedIsUnreachable) {
  const explore::ExploreEnd end = end_with_another_behind_the_door(false);
  EXPECT_EQ(end.kind, EndKind::kUnreachable);
  EXPECT_FALSE(end.unreachable.empty());
}

TEST(TopologicalStrategy, WhatAnotherRobotHasComeToSinceIsNotUnreachable) {
  const auto goes_there = [](double t_s, RobotTopology& other) {
    if (t_s > 45.0 && other.topology.nodes.empty()) {
      TopologyNode node;
      node.id = 1;
      node.map_T_base = kBehindTheDoor;
      other.topology.nodes = {node};
      other.topology.current = node.id;
    }
  };
  EXPECT_EQ(end_with_another_behind_the_door(false, goes_there).kind, EndKind::kComplete);
}

TEST(TopologicalStrategy, ComesThroughAMapThatMoves) {
  Exploration exploration = exploration_of();
  ToyExplorer robot(explore::two_rooms(), {1.0, 1.0, 0.3}, 7, 6.0);
  const Pose2 new_T_old{3.0, -2.0, 0.7};
  ToyExplorer::Hooks hooks;
  hooks.exploration = [&](double t_s, Exploration& moved) {
    if (std::abs(t_s - 20.0) < 0.01) {
      robot.move_map(new_T_old);
      moved.transform(new_T_old);
    }
  };
  const ToyRun run = robot.run(exploration, 900.0, hooks);
  ASSERT_TRUE(run.end.has_value());
  EXPECT_EQ(run.end->kind, EndKind::kComplete);
  EXPECT_GT(run.wall_share, kWallShare);
}

TEST(TopologicalStrategy, EndsWithoutALaser) {
  Exploration exploration = exploration_of();
  ToyExplorer robot(explore::two_rooms(), {1.0, 1.0, 0.3}, 7, 6.0);
  ToyExplorer::Hooks hooks;
  hooks.input = [](double t_s, ExploreInput& input) {
    if (t_s > 12.0) {
      input.laser = nullptr;
    }
  };
  const ToyRun run = robot.run(exploration, 300.0, hooks);
  EXPECT_TRUE(run.end.has_value());
}

TEST(TopologicalParams, AreRefusedWhenTheyMakeNoSense) {
  EXPECT_TRUE(validate(TopologicalParams{}));
  TopologicalParams params;
  params.map.tree.layers = 0;
  EXPECT_FALSE(validate(params));
  params = {};
  params.map.tree.min_goal_radius_m = 0.5;  // a goal behind the robot
  EXPECT_FALSE(validate(params));
  params = {};
  params.map.node_distance_m = 0.0;
  EXPECT_FALSE(validate(params));
  params = {};
  params.auction.near_m = 0.0;
  EXPECT_FALSE(validate(params));
}

TEST(TopologicalStrategy, DoesNotExploreAgainWhatItRemembers) {
  Exploration first = exploration_of();
  ToyExplorer robot(explore::two_rooms(), {1.0, 1.0, 0.3}, 7, 6.0);
  const ToyRun whole = robot.run(first, 900.0);
  ASSERT_TRUE(whole.end.has_value());
  const std::optional<TopologyMemory> memory = first.strategy().memory();
  ASSERT_TRUE(memory.has_value());
  Exploration again = exploration_of();
  again.remember(*memory);
  const ToyRun rest = robot.run(again, 900.0);
  ASSERT_TRUE(rest.end.has_value());
  EXPECT_LT(rest.path_m, 0.2 * whole.path_m);
  EXPECT_GE(again.strategy().topology()->nodes.size(), memory->topology.nodes.size());
}

}  // namespace
}  // namespace seeker::fleet
