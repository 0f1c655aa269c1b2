#include "server/explore/active_strategy.hpp"

#include <algorithm>
#include <utility>

#include "server/nav/frontiers.hpp"

namespace seeker::explore {
namespace {

constexpr const char* kExplorePhase = "explore";

}  // namespace

ActiveStrategy::ActiveStrategy(const ExploreParams& params)
    : params_(params),
      hold_(params.one_step, params.driver.follower.clearance),
      watch_(params.one_step),
      look_round_(params.one_step),
      follower_(params.one_step, params.wall),
      path_(params, make_opening_chooser()) {}

StrategyStep ActiveStrategy::step(const StrategyInput& input) {
  StrategyStep out;
  if (looks_first(input.now)) {
    out.phase = kExplorePhase;
    out.activity = "observing the walls around the start";
    return out;
  }
  if (mode_ == Mode::kPath) {
    follow_path(input, out);
  } else if (mode_ != Mode::kDone && hold_.ready(input)) {
    decide(input, out);
  }
  switch (mode_) {
    case Mode::kPath: return out;
    case Mode::kDone:
      out.command = {};
      out.done = true;
      out.phase = kExplorePhase;
      break;
    case Mode::kExplore:
    case Mode::kWall:
      out.command = hold_.command(input);
      out.phase = mode_ == Mode::kWall ? "wall" : kExplorePhase;
      break;
  }
  out.activity = why_;
  return out;
}

bool ActiveStrategy::looks_first(RobotTime now) {
  began_ = began_.value_or(now);
  return to_seconds(now - *began_) < params_.one_step.first_look_s;
}

std::vector<MapSegment> ActiveStrategy::believed(const std::vector<MapSegment>& segments) const {
  std::vector<MapSegment> all = segments;
  for (MapSegment& segment : all) {
    segment.left_real =
        segment.left_real || nav::near_any(segment.left(), closed_map_, params_.one_step.closed_radius_m);
    segment.right_real =
        segment.right_real || nav::near_any(segment.right(), closed_map_, params_.one_step.closed_radius_m);
  }
  return all;
}

void ActiveStrategy::decide(const StrategyInput& input, StrategyStep& out) {
  if (const std::optional<Twist2> rotation = look_round_.next(input.covariance)) {
    why_ = "rotating on the spot: the walls behind reduce the uncertainty of the walls ahead";
    hold_.start(*rotation, input.now);
    return;
  }
  const auto view = input.floors.view();
  const MapSize size = size_of(input.segments, view && params_.one_step.use_floor ? view->get() : nullptr);
  out.step_done = true;
  if (mode_ == Mode::kWall) {
    follow_wall(input, size, out);
  } else {
    explore(input, size, out);
  }
}

void ActiveStrategy::explore(const StrategyInput& input, const MapSize& size, StrategyStep& out) {
  OneStepChoice choice = choose_one_step(input, believed(input.segments), params_.one_step);
  const bool trapped = watch_.note(choice.gains_nothing || !choice.control, size);
  why_ = choice.decision.why;
  out.decision = std::move(choice.decision);
  if (trapped) {
    out.decision->chosen.reset();
    begin_wall(input, size, out);
  } else if (choice.control) {
    hold_.start(*choice.control, input.now);
  } else {
    hold_.cancel(input.now);
  }
}

void ActiveStrategy::begin_wall(const StrategyInput& input, const MapSize& size, StrategyStep& out) {
  if (!follower_.start(input.map_T_base, believed(input.segments))) {
    why_ = "no wall leads to an open end";
    begin_path(input, out);
    return;
  }
  mode_ = Mode::kWall;
  wall_since_ = input.now;
  wall_size_ = size;
  follow_wall(input, size, out);
}

void ActiveStrategy::follow_wall(const StrategyInput& input, const MapSize& size, StrategyStep& out) {
  const double grown_m = size.walls_m - wall_size_.walls_m;
  const bool new_segment = size.segments > wall_size_.segments && grown_m >= params_.wall.new_segment_m;
  if (grown_m >= params_.wall.leave_growth_m || new_segment) {
    mode_ = Mode::kExplore;
    watch_.reset();
    explore(input, size, out);
    return;
  }
  if (params_.wall.growth_per_step) {
    wall_size_ = size;
  }
  wall_size_.segments = std::max(wall_size_.segments, size.segments);
  const std::vector<MapSegment> segments = believed(input.segments);
  const SightScene scene = scene_around(input, segments, params_.one_step, nullptr);
  const ControlCheck check(input, scene, params_.one_step.swept_radius_m, longest_step_m(params_.one_step),
                           params_.one_step.use_floor);
  WallChoice choice = follower_.decide(input.map_T_base, segments, check);
  wall_goal_map_ = choice.goal_map ? choice.goal_map : wall_goal_map_;
  const bool late = to_seconds(input.now - wall_since_) > params_.wall.time_limit_s;
  if (late || !choice.control) {
    why_ = late ? "following walls took too long" : choice.failure;
    give_end_up(wall_goal_map_);
    wall_goal_map_.reset();
    begin_path(input, out);
    return;
  }
  why_ = choice.decision.why;
  out.decision = std::move(choice.decision);
  hold_.start(*choice.control, input.now);
}

void ActiveStrategy::give_end_up(const std::optional<Point2>& p_map) {
  if (p_map && !nav::near_any(*p_map, closed_map_, 0.5 * params_.one_step.closed_radius_m)) {
    closed_map_.push_back(*p_map);
  }
}

void ActiveStrategy::begin_path(const StrategyInput& input, StrategyStep& out) {
  hold_.cancel(input.now);
  if (!params_.one_step.escape_by_path) {
    mode_ = Mode::kDone;
    why_ += ": nothing is left to explore";
    return;
  }
  mode_ = Mode::kPath;
  path_.interrupted(input.now);
  const std::optional<ExploreDecision> trapped = std::move(out.decision);
  follow_path(input, out);
  if (trapped && !out.decision) {
    out.decision = trapped;
  }
}

void ActiveStrategy::follow_path(const StrategyInput& input, StrategyStep& out) {
  out = path_.step(input);
  why_ = out.activity;
  if (out.done) {
    mode_ = Mode::kDone;
  } else if (out.step_done) {  // it has observed an opening, also while driving: the objective again
    mode_ = Mode::kExplore;
    watch_.reset(true);
    hold_.cancel(input.now);
  }
}

void ActiveStrategy::interrupted(RobotTime now) {
  look_round_.cancel();
  hold_.cancel(now);
  path_.interrupted(now);
  watch_.reset();
  mode_ = Mode::kExplore;
}

void ActiveStrategy::try_again(RobotTime now) {
  path_.try_again(now);
  interrupted(now);
}

void ActiveStrategy::transform(const MapMove& move) {
  path_.transform(move);
  for (Point2& p : closed_map_) {
    p = move * p;
  }
  if (wall_goal_map_) {
    wall_goal_map_ = move * *wall_goal_map_;
  }
}

}  // namespace seeker::explore
