#include "server/fleet/topological_strategy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/text.hpp"
#include "server/explore/view_gain.hpp"
#include "server/nav/frontiers.hpp"

namespace seeker::fleet {
namespace {

constexpr double kTurn_rad_s = 0.6;
/// Rotation after which a rotating robot observes again.
constexpr double kLookStep_rad = deg_to_rad(45.0);
constexpr double kWaitTick_s = 1.0;
/// Goals so near to each other fail together.
constexpr double kSamePlace_m = 0.5;

const FleetView kAlone;

const FleetView& fleet_of(const explore::StrategyInput& input) {
  return input.fleet != nullptr ? *input.fleet : kAlone;
}

double field_of_view_rad(const LaserScan& scan) {
  return std::min(kTwoPi, std::abs(scan.angle_step_rad) * static_cast<double>(scan.ranges_m.size()));
}

}  // namespace

Status validate(const TopologicalParams& params) {
  const SpaceTreeParams& tree = params.map.tree;
  constexpr int kMostLayers = 64;
  const bool sound = tree.corridor_width_m > 0.0 && tree.layers >= 1 && tree.layers <= kMostLayers &&
                     tree.max_range_m > tree.corridor_width_m && tree.min_goal_radius_m >= tree.corridor_width_m &&
                     tree.max_goal_span_rad > 0.0;
  if (!sound) {
    return fail(Errc::kInvalidArgument,
                "the space tree needs 1..64 layers, a width and an angle above 0, and a range and a least radius of "
                "goals above the width");
  }
  if (params.map.node_distance_m <= 0.0 || params.map.max_edge_m <= 0.0) {
    return fail(Errc::kInvalidArgument, "the distance of nodes and the longest edge must be above 0");
  }
  if (params.max_failures < 1 || params.replan_period_s <= 0.0 || params.retry_s < 0.0 || params.scan_limit_s <= 0.0 ||
      params.patience_s < 0.0 || params.takeover_m < 0.0 || params.auction.lambda_1_m < 0.0 ||
      params.auction.near_m <= 0.0) {
    return fail(Errc::kInvalidArgument, "failures, periods and the auction's numbers must be above 0");
  }
  return {};
}

TopologicalStrategy::TopologicalStrategy(const explore::ExploreParams& params, const TopologicalParams& topological)
    : params_(params), topological_(topological), map_(topological.map), driver_(params.driver) {}

explore::StrategyStep TopologicalStrategy::step(const Input& input) {
  Step out;
  out.phase = "drive";
  if (input.laser != nullptr || !scan_at_) {
    scan_at_ = input.now;
  }
  switch (state_) {
    case State::kChoose: choose(input, out); break;
    case State::kRotate: rotate(input, out); break;
    case State::kGoal:
    case State::kPath: drive(input, out); break;
    case State::kWait:
      if (to_seconds(input.now - since_) >= kWaitTick_s) {
        choose(input, out);
      }
      break;
    case State::kDone: break;
  }
  if (out.activity.empty()) {
    out.activity = why_;
  }
  if (state_ == State::kGoal || state_ == State::kPath) {
    out.planned_path = driver_.path();
  } else if (state_ == State::kWait) {
    out.phase = "wait";
  } else if (state_ == State::kDone) {
    out.done = true;
    out.unreachable = given_up(input);
  }
  return out;
}

/// Nothing without a map to drive on or a scan to look with.
std::optional<TopologicalStrategy::Scene> TopologicalStrategy::look(const Input& input) const {
  auto floor = input.floors.view();
  if (!floor || input.laser == nullptr) {
    return std::nullopt;
  }
  const nav::CostMap& cost = (*floor)->cost;
  return Scene{*floor, {corridors_of(cost), topological_.map.tree.corridor_width_m}, fleet_of(input)};
}

void TopologicalStrategy::choose(const Input& input, Step& out) {
  since_ = input.now;
  considered_ = input.now;
  goal_.reset();
  const auto scene = look(input);
  if (!scene) {
    const auto floor = input.floors.view();
    const std::string cause = floor ? "there is no scan of a laser" : floor.error().message;
    if (!rotated_at_) {
      begin_rotation(input, "rotating on the spot to observe more: " + cause);
    } else if (floor && to_seconds(input.now - *scan_at_) < topological_.scan_limit_s) {
      wait(input, "waiting for a scan");
    } else {
      finish(cause, out);
    }
    return;
  }
  note_place(input, *scene);
  if (!rotated_at_ && field_of_view_rad(*input.laser) < kTwoPi - kLookStep_rad) {
    begin_rotation(input, "rotating to observe at the first node");
    return;
  }
  map_.settle(scene->fleet.others, scene->corridors);
  GoalChoice choice = choose_goal(question(input, *scene));
  if (!choice.others_idle) {
    all_idle_since_.reset();
  } else if (!all_idle_since_) {
    all_idle_since_ = input.now;
  }
  if (choice.goal || choice.decision.why != published_) {  // a robot that waits asks every second
    published_ = choice.decision.why;
    out.decision = std::move(choice.decision);
  }
  if (!choice.goal) {
    wait_or_finish(input, choice, out);
    return;
  }
  go(input, *scene, *std::move(choice.goal));
}

ChoiceInput TopologicalStrategy::question(const Input& input, const Scene& scene) const {
  return {map_.topology(),
          scene.fleet,
          input.map_T_base,
          scene.corridors,
          topological_.map.max_edge_m,
          topological_.map.node_distance_m,
          [&](const Point2& p_map) { return left_out(p_map, input.now); },
          [&](const Point2& p_map) {
            return explore::view_gain(scene.floor->cost, p_map, params_.one_step.sensor).area_m2;
          },
          topological_.auction,
          patient(input.now),
          topological_.takeover_m};
}

/// Each robot may leave out what the other waits for it to take: then all would wait for good.
bool TopologicalStrategy::patient(RobotTime now) const {
  return !all_idle_since_ || to_seconds(now - *all_idle_since_) < topological_.patience_s;
}

void TopologicalStrategy::wait_or_finish(const Input& input, const GoalChoice& choice, Step& out) {
  if (resting(input.now)) {
    wait(input, "waiting to try again what could not be reached");
  } else if (rotated_at_ != map_.topology().current && field_of_view_rad(*input.laser) < kTwoPi - kLookStep_rad) {
    begin_rotation(input, choice.others_busy ? "rotating to observe while other robots are at what is left to explore"
                                             : "rotating to observe, for no node has a goal left");
  } else if (choice.others_busy) {
    wait(input, "other robots are at what is left to explore");
  } else {
    finish("no node has a goal left", out);
  }
}

void TopologicalStrategy::wait(const Input& input, std::string why) {
  state_ = State::kWait;
  since_ = input.now;
  why_ = std::move(why);
}

void TopologicalStrategy::finish(std::string why, Step& out) {
  driver_.stop();
  goal_.reset();
  state_ = State::kDone;
  why_ = std::move(why);
  out.step_done = true;
}

/// Rotates by the part of the circle outside the field of view; by a full circle where no node exists yet.
void TopologicalStrategy::begin_rotation(const Input& input, std::string why) {
  state_ = State::kRotate;
  why_ = std::move(why);
  rotated_at_ = map_.topology().current;
  rotated_rad_ = 0.0;
  looked_rad_ = 0.0;
  rotate_until_rad_ = input.laser != nullptr && *rotated_at_ != 0 ? kTwoPi - field_of_view_rad(*input.laser) : kTwoPi;
  heading_rad_ = input.map_T_base.theta_rad;
}

void TopologicalStrategy::rotate(const Input& input, Step& out) {
  out.phase = "turn";
  rotated_rad_ += std::abs(wrap_angle(input.map_T_base.theta_rad - heading_rad_));
  heading_rad_ = input.map_T_base.theta_rad;
  const bool done = rotated_rad_ >= rotate_until_rad_;
  const auto scene = look(input);
  if (scene && map_.current() != nullptr && (done || rotated_rad_ - looked_rad_ >= kLookStep_rad)) {
    looked_rad_ = rotated_rad_;
    look_again(input, *scene);
  }
  if (done) {
    change("has rotated to observe", out);
    return;
  }
  out.command.omega_rad_s = kTurn_rad_s;
}

/// The next step chooses again.
void TopologicalStrategy::change(std::string why, Step& out) {
  state_ = State::kChoose;
  why_ = std::move(why);
  out.step_done = true;
}

/// The robot's observations at its position are added to the present node.
void TopologicalStrategy::look_again(const Input& input, const Scene& scene) {
  (void)map_.look_again(input.map_T_base, build_space_tree(*input.laser, topological_.map.tree), scene.fleet.others,
                        scene.corridors);
}

void TopologicalStrategy::create_node(const Input& input, const Scene& scene) {
  (void)map_.create(input.map_T_base, build_space_tree(*input.laser, topological_.map.tree), scene.fleet.others,
                    scene.corridors);
}

/// At the nearest node in reach, else at a new one.
void TopologicalStrategy::note_place(const Input& input, const Scene& scene) {
  if (const auto known = map_.node_at(input.map_T_base.translation(), scene.corridors)) {
    map_.arrive(*known);
  } else {
    create_node(input, scene);
  }
}

bool TopologicalStrategy::left_out(const Point2& p_map, RobotTime now) const {
  return nav::near_any(p_map, done_map_, kSamePlace_m) ||
         std::any_of(failures_.begin(), failures_.end(), [&](const Failure& failure) {
           return (failure.p_map - p_map).norm() < kSamePlace_m &&
                  (failure.count >= topological_.max_failures || to_seconds(now - failure.at) < topological_.retry_s);
         });
}

/// Something may still be tried again later.
bool TopologicalStrategy::resting(RobotTime now) const {
  return std::any_of(failures_.begin(), failures_.end(), [&](const Failure& failure) {
    return failure.count < topological_.max_failures && to_seconds(now - failure.at) < topological_.retry_s;
  });
}

/// Goals that no drive has reached, and that no robot has reached by another path since.
std::vector<UnreachablePlace> TopologicalStrategy::given_up(const Input& input) const {
  const auto floor = input.floors.view();
  const FleetView& fleet = fleet_of(input);
  std::vector<UnreachablePlace> places;
  for (const Failure& failure : failures_) {
    const bool seen_to =
        floor && map_.has_node_near(failure.p_map, fleet.others,
                                    {corridors_of((*floor)->cost), topological_.map.tree.corridor_width_m});
    if (failure.count >= topological_.max_failures && !seen_to) {
      places.push_back({failure.p_map, UnreachableCause::kBlocked, 0.0, "no drive came to this goal"});
    }
  }
  return places;
}

void TopologicalStrategy::failed(const Input& input, const Scene* scene, const std::string& why) {
  const Point2 p_map = goal_->p_map;
  if (scene != nullptr && another_is_at(p_map, *scene)) {
    drop_goal();
    driver_.stop();
    state_ = State::kChoose;
    why_ = "another robot is at the goal at " + text(p_map);
    return;
  }
  auto same = std::find_if(failures_.begin(), failures_.end(),
                           [&](const Failure& failure) { return (failure.p_map - p_map).norm() < kSamePlace_m; });
  if (same == failures_.end()) {
    same = failures_.insert(failures_.end(), {p_map, 0, input.now});
  }
  ++same->count;
  same->at = input.now;
  if (same->count >= topological_.max_failures && !goal_->robot) {
    map_.close(goal_->id);
  }
  driver_.stop();
  state_ = State::kChoose;
  why_ = "no path to the goal at " + text(p_map) + ": " + why;
}

std::optional<Point2> TopologicalStrategy::target_map() const {
  return goal_ ? std::optional(goal_->p_map) : std::nullopt;
}

std::optional<TopologyMemory> TopologicalStrategy::memory() const {
  return TopologyMemory{map_.topology(), map_.closed_map(), done_map_};
}

void TopologicalStrategy::remember(const TopologyMemory& memory) {
  map_ = TopologyMap(topological_.map, memory.topology, memory.closed_map);
  done_map_ = memory.looked_at_map;
}

void TopologicalStrategy::interrupted(RobotTime now) {
  since_ = now;
  scan_at_.reset();
  driver_.stop();
  goal_.reset();
  if (state_ == State::kDone || state_ == State::kRotate) {
    rotated_at_.reset();  // it rotates to observe again
  }
  state_ = State::kChoose;
}

void TopologicalStrategy::transform(const MapMove& move) {
  map_.transform(move);
  for (Failure& failure : failures_) {
    failure.p_map = move * failure.p_map;
  }
  for (Point2& p_map : done_map_) {
    p_map = move * p_map;
  }
  driver_.stop();
  goal_.reset();
  state_ = State::kChoose;
}

}  // namespace seeker::fleet
