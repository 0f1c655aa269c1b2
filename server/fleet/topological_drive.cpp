#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/text.hpp"
#include "server/fleet/topological_strategy.hpp"

namespace seeker::fleet {
namespace {

/// A place so near to the goal is the goal.
constexpr double kAtGoal_m = 0.4;
/// The map leads nearer to the goal than it did: worth another drive.
constexpr double kNearer_m = 0.3;
/// Nodes of the path within this distance have been reached.
constexpr double kAtNode_m = 0.5;

double distance_to(const Pose2& pose, const Point2& p) { return (pose.translation() - p).norm(); }

}  // namespace

void TopologicalStrategy::go(const Input& input, const Scene& scene, PendingGoal goal) {
  goal_ = std::move(goal);
  since_ = input.now;
  std::vector<Point2> path_map = goal_->path_map;
  while (!path_map.empty() && distance_to(input.map_T_base, path_map.front()) < kAtNode_m) {
    path_map.erase(path_map.begin());
  }
  if (path_map.empty() || scene.corridors.free(input.map_T_base.translation(), goal_->p_map)) {
    go_to_goal(input, scene);
    return;
  }
  const Point2 next_map = *farthest_visible(input.map_T_base.translation(), path_map, scene.corridors);
  why_ = "back along the nodes to the goal at " + text(goal_->p_map);
  state_ = State::kPath;
  if (!driver_.start(input, next_map)) {
    failed(input, &scene, driver_.reason());
  }
}

void TopologicalStrategy::go_to_goal(const Input& input, const Scene& scene) {
  state_ = State::kGoal;
  why_ = "driving to the goal at " + text(goal_->p_map);
  const auto aim_map = nearest_now(input, scene);
  if (!aim_map) {
    failed(input, &scene, "the map leads nowhere near it");
    return;
  }
  aim_map_ = *aim_map;
  if (!driver_.start(input, aim_map_)) {
    failed(input, &scene, driver_.reason());
  }
}

/// The last reachable position of the straight line from its node to the goal: the goal itself, or where the known
/// floor ends.
std::optional<Point2> TopologicalStrategy::nearest_on_line(const Input& input, const nav::CostMap& cost) const {
  const auto costs = nav::DistanceField::build(cost, input.map_T_base.translation());
  if (!costs) {
    return std::nullopt;
  }
  const Point2 from_map = goal_->path_map.empty() ? map_.current()->map_T_base.translation() : goal_->path_map.back();
  const Point2 line = from_map - goal_->p_map;
  const int steps = static_cast<int>(std::ceil(line.norm() / cost.frame().resolution_m));
  for (int k = 0; k <= steps; ++k) {
    const Point2 p_map = goal_->p_map + (steps > 0 ? static_cast<double>(k) / steps : 0.0) * line;
    if (costs->cost_to(p_map)) {
      return p_map;
    }
  }
  return std::nullopt;
}

/// The same with other robots as obstacles, as long as a path is left.
std::optional<Point2> TopologicalStrategy::nearest_now(const Input& input, const Scene& scene) const {
  const auto crowded = input.floors.around_movers(*scene.floor);
  const auto aim_map = crowded ? nearest_on_line(input, *crowded) : std::nullopt;
  return aim_map ? aim_map : nearest_on_line(input, scene.floor->cost);
}

double TopologicalStrategy::short_of_goal_m() const { return (aim_map_ - goal_->p_map).norm(); }

bool TopologicalStrategy::is_nearer(const std::optional<Point2>& aim_map) const {
  return aim_map && (*aim_map - goal_->p_map).norm() < short_of_goal_m() - kNearer_m;
}

void TopologicalStrategy::drive(const Input& input, Step& out) {
  const nav::DriveStep driven = driver_.step(input);
  out.command = driven.command;
  const auto scene = look(input);
  switch (driven.state) {
    case nav::DriveState::kDriving:
      if (scene) {
        pass(input, *scene, out);
      }
      return;
    case nav::DriveState::kArrived:
      if (scene) {
        arrived(input, *scene, out);
      } else {
        change("waiting for a scan", out);
      }
      return;
    case nav::DriveState::kFailed:
    case nav::DriveState::kIdle: failed(input, scene ? &*scene : nullptr, driven.reason); return;
  }
}

/// Nodes are made along the path, too, so that the passed area has nodes.
void TopologicalStrategy::pass(const Input& input, const Scene& scene, Step& out) {
  const TopologyNode* before = map_.current();
  if (before != nullptr && distance_m(before->map_T_base, input.map_T_base) > topological_.map.node_distance_m) {
    const std::size_t nodes = map_.topology().nodes.size();
    note_place(input, scene);
    if (settle_goal(scene)) {
      change("the goal at " + text(goal_->p_map) + " has been observed while driving", out);
      return;
    }
    if (state_ == State::kPath && map_.topology().nodes.size() > nodes && !map_.current()->goals.empty()) {
      change("a new goal along the path", out);
      return;
    }
  }
  if (to_seconds(input.now - considered_) >= topological_.replan_period_s) {
    considered_ = input.now;
    reconsider(input, scene, out);
  }
}

/// The nodes of others may have settled the goal, another robot may want it too, the map may lead nearer to it; on the
/// return a new goal may have come into sight.
void TopologicalStrategy::reconsider(const Input& input, const Scene& scene, Step& out) {
  map_.settle(scene.fleet.others, scene.corridors);
  if (settle_goal(scene)) {
    change("the goal at " + text(goal_->p_map) + " has been seen meanwhile", out);
    return;
  }
  if (yields(question(input, scene), *goal_)) {
    change("another robot drives to the goal at " + text(goal_->p_map), out);
    return;
  }
  if (state_ == State::kPath) {
    note_place(input, scene);
    const std::size_t goals = map_.current()->goals.size();
    look_again(input, scene);
    if (map_.current()->goals.size() > goals) {
      change("a new goal along the path", out);
    }
  } else {
    if (short_of_goal_m() > kAtGoal_m && is_nearer(nearest_now(input, scene))) {
      go_to_goal(input, scene);
    }
  }
}

void TopologicalStrategy::arrived(const Input& input, const Scene& scene, Step& out) {
  if (state_ == State::kPath) {
    note_place(input, scene);
    change("at a node of the path", out);
    return;
  }
  const bool short_of_goal = short_of_goal_m() > kAtGoal_m;
  if (short_of_goal && is_nearer(nearest_now(input, scene))) {
    go_to_goal(input, scene);
    return;
  }
  const auto known = map_.node_at(input.map_T_base.translation(), scene.corridors);
  if (known && distance_m(map_.find(*known)->map_T_base, input.map_T_base) < 0.5 * topological_.map.node_distance_m) {
    map_.arrive(*known);
    look_again(input, scene);
    map_.settle(scene.fleet.others, scene.corridors);
  } else {
    create_node(input, scene);
  }
  if (!settle_goal(scene)) {  // as near as the map leads
    if (short_of_goal && is_nearer(nearest_on_line(input, scene.floor->cost))) {
      failed(input, &scene, "another robot blocks the path");
      return;
    }
    drop_goal();
  }
  change("at the goal", out);
}

/// A goal of another robot is left out from then on: that robot may never see from its own map that it is settled, and
/// go on to offer it.
bool TopologicalStrategy::settle_goal(const Scene& scene) {
  const bool settled = goal_settled(scene);
  if (settled && goal_->robot) {
    done_map_.push_back(goal_->p_map);
  }
  return settled;
}

bool TopologicalStrategy::goal_settled(const Scene& scene) const {
  if (!goal_->robot) {
    return !map_.has(goal_->id);
  }
  return map_.has_node_near(goal_->p_map, {}, scene.corridors);
}

/// A robot that waits at a place keeps others from it for as long as it waits, and explores what it sees there.
bool TopologicalStrategy::another_is_at(const Point2& p_map, const Scene& scene) const {
  return std::any_of(scene.fleet.others.begin(), scene.fleet.others.end(), [&](const RobotTopology& other) {
    return other.active && distance_to(other.map_T_base, p_map) < topological_.map.node_distance_m &&
           scene.corridors.free(other.map_T_base.translation(), p_map);
  });
}

/// Nobody need go there any more.
void TopologicalStrategy::drop_goal() {
  if (goal_->robot) {
    done_map_.push_back(goal_->p_map);
  } else {
    map_.close(goal_->id);
  }
}

}  // namespace seeker::fleet
