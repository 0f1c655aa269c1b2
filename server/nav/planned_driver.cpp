#include "server/nav/planned_driver.hpp"

#include <cmath>
#include <utility>

#include "common/core/angle.hpp"

namespace seeker::nav {
namespace {

/// With a laser only near echoes of the front count, against noise of the sonars; without, everything in use.
constexpr double kNearEcho_m = 0.5;
constexpr double kFrontEcho_rad = deg_to_rad(35.0);
constexpr double kFarEcho_m = 2.0;
/// A path blocked from within this distance is blocked by an obstacle that the map may not show.
constexpr double kUnmappedObstacle_m = 0.8;

bool echo_counts(const SonarReading& reading, bool laser_fitted) {
  if (!std::isfinite(reading.range_m)) {
    return false;
  }
  if (!laser_fitted) {
    return reading.range_m < kFarEcho_m;
  }
  return reading.range_m < kNearEcho_m && std::abs(reading.base_T_sonar.theta_rad) < kFrontEcho_rad;
}

}  // namespace

std::vector<Point2> obstacles_in_base(const DriveInput& input) {
  std::vector<Point2> points;
  if (input.laser != nullptr) {
    points = points_in_base(*input.laser);
  }
  if (input.sonar != nullptr) {
    for (const SonarReading& reading : input.sonar->readings) {
      if (echo_counts(reading, input.laser != nullptr)) {
        points.push_back(reading.base_T_sonar * Point2(reading.range_m, 0.0));
      }
    }
  }
  return points;
}

PlannedDriver::PlannedDriver(const DriverParams& params) : params_(params), follower_(params.follower) {}

bool PlannedDriver::start(const DriveInput& input, const Point2& goal_map, std::optional<double> final_heading_rad) {
  goal_ = goal_map;
  through_.reset();
  final_heading_rad_ = final_heading_rad;
  failures_ = 0;
  drive_progress_.start(input.now);
  driving_ = plan(input);
  return driving_;
}

bool PlannedDriver::go_on(const DriveInput& input, const Point2& next_goal_map,
                          std::optional<double> final_heading_rad) {
  const Point2 before = std::exchange(goal_, next_goal_map);
  const auto through_before = std::exchange(through_, Through{before});
  auto path = find_path(input);
  if (!path) {
    goal_ = before;
    through_ = through_before;
    return false;
  }
  final_heading_rad_ = final_heading_rad;
  drive_progress_.start(input.now);
  take(std::move(*path), input.now);
  return true;
}

void PlannedDriver::transform(const MapMove& move) {
  const Pose2 new_T_old = move.at(goal_);
  goal_ = new_T_old * goal_;
  if (through_) {
    through_->p_map = move * through_->p_map;
  }
  if (final_heading_rad_) {
    final_heading_rad_ = wrap_angle(*final_heading_rad_ + new_T_old.theta_rad);
  }
  follower_.transform(move);
}

void PlannedDriver::stop() {
  driving_ = false;
  through_.reset();
  follower_.clear();
}

Result<Path> PlannedDriver::find_path(const DriveInput& input) {
  const Point2 here = input.map_T_base.translation();
  if (!through_) {
    return find_leg(input, here, goal_);
  }
  auto path = find_leg(input, here, through_->p_map);
  auto rest = path ? find_leg(input, path->waypoints.back(), goal_) : path;
  if (!rest) {
    return rest;
  }
  through_->beyond_m = rest->length_m;
  path->waypoints.insert(path->waypoints.end(), rest->waypoints.begin() + 1, rest->waypoints.end());
  path->length_m += rest->length_m;
  path->cost += rest->cost;
  return path;
}

Result<Path> PlannedDriver::find_leg(const DriveInput& input, const Point2& from_map, const Point2& to_map) const {
  const auto floor = input.floors.view(true);
  if (!floor) {
    return tl::unexpected(floor.error());
  }
  if (const std::optional<CostMap> crowded = input.floors.around_movers(**floor)) {
    if (auto path = nav::plan(*crowded, from_map, to_map, params_.planner)) {
      return path;
    }  // otherwise up to the mover that blocks the path: it may have moved on by then
  }
  return nav::plan((*floor)->cost, from_map, to_map, params_.planner);
}

UnreachableCause PlannedDriver::cause_of_failure(const DriveInput& input) const {
  const Point2 here = input.map_T_base.translation();
  if (const auto floor = input.floors.view()) {
    return cause_of_no_path((*floor)->cost, here, goal_, params_.planner);
  }
  return input.floors.areas().cause_of_no_floor(here);
}

bool PlannedDriver::plan(const DriveInput& input) {
  auto path = find_path(input);
  if (!path) {
    failure_ = {cause_of_failure(input), path.error().message};
    return false;
  }
  take(std::move(*path), input.now);
  return true;
}

void PlannedDriver::take(Path path, RobotTime now) {
  planned_ = now;
  path_progress_.start(now);
  follower_.set_path(std::move(path), now, final_heading_rad_);
}

void PlannedDriver::refresh(const DriveInput& input) {
  const bool due = params_.replan_period_s > 0.0 && to_seconds(input.now - planned_) >= params_.replan_period_s;
  if (!due || follower_.at_goal()) {
    return;
  }
  planned_ = input.now;
  if (auto path = find_path(input)) {
    follower_.replace_path(std::move(*path), input.now);
  }
}

DriveStep PlannedDriver::plan_again(const DriveInput& input, const FollowStep& follow) {
  for (const Point2& p : obstacles_in_base(input)) {
    if (p.norm() < kUnmappedObstacle_m && p.x() > 0.0) {
      input.floors.add_obstacle(input.map_T_base * p);
    }
  }
  if (++failures_ > params_.max_failures || !plan(input)) {
    stop();
    const DriveFailure failure =
        failures_ > params_.max_failures ? DriveFailure{UnreachableCause::kBlocked, follow.reason} : failure_;
    return {{}, DriveState::kFailed, failure.text, 0.0, failure.cause};
  }
  return {{}, DriveState::kDriving, {}, follow.remaining_m};
}

DriveStep PlannedDriver::step(const DriveInput& input) {
  if (!driving_) {
    return {};
  }
  refresh(input);
  const FollowStep follow = follower_.step(input.map_T_base, obstacles_in_base(input), input.now);
  if (drive_progress_.nearer(follow.remaining_m, kNearer_m, input.now)) {
    failures_ = 0;
  }
  if (through_ && follow.remaining_m <= through_->beyond_m + params_.follower.goal_tolerance_m) {
    through_.reset();
  }
  switch (follow.state) {
    case FollowState::kFollowing:
      if (path_progress_.idle_s(follow.remaining_m, kNearer_m, input.now) > params_.goal_time_s) {
        stop();
        return {{}, DriveState::kFailed, "no progress towards the goal"};
      }
      return {follow.command, DriveState::kDriving, {}, follow.remaining_m};
    case FollowState::kArrived: stop(); return {{}, DriveState::kArrived, {}};
    case FollowState::kBlocked:
    case FollowState::kStuck:
      if (follow.remaining_m < params_.close_enough_m) {
        stop();
        return {{}, DriveState::kArrived, {}};
      }
      return plan_again(input, follow);
    case FollowState::kIdle: break;
  }
  driving_ = false;
  return {{}, DriveState::kFailed, "no path"};
}

}  // namespace seeker::nav
