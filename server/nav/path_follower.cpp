#include "server/nav/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/polygon.hpp"

namespace seeker::nav {
namespace {

constexpr double kFirstStep_s = 0.1;    ///< assumed before the first step
constexpr double kLongestStep_s = 0.5;  ///< a loop that slept longer may not jump in speed
/// The base is asked to brake with this share of what it can, so that it ends where it should.
constexpr double kBrakeShare = 0.8;
constexpr double kWindowBack_m = 0.5;   ///< the robot's projection is searched this far behind the last one
constexpr double kWindowAhead_m = 1.5;  ///< and this far ahead
constexpr double kLookaheadStep_m = 0.05;
/// A path that is longer than what was left of the previous one by this much leads around another side.
constexpr double kAnotherPath_m = 0.5;
/// So far along the path the robot follows it closely after an obstacle left no room to drive.
constexpr double kTight_m = 0.5;
constexpr double kStanding_m_s = 0.03;
constexpr double kStanding_rad_s = 0.08;

double approach(double from, double to, double step) { return std::clamp(to, from - step, from + step); }

Point2 nearest_on_segment(const Point2& a, const Point2& b, const Point2& p) {
  const double length2 = (b - a).squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0.0;
  return a + t * (b - a);
}

}  // namespace

PathFollower::PathFollower(const FollowerParams& params) : params_(params) {
  SEEKER_ASSERT(params.max_v_m_s > 0.0 && params.accel_m_s2 > 0.0 && params.alpha_rad_s2 > 0.0);
}

void PathFollower::set_path(Path path, RobotTime now, std::optional<double> final_heading_rad) {
  path_ = std::move(path);
  arc_m_.assign(path_.waypoints.size(), 0.0);
  for (std::size_t k = 1; k < arc_m_.size(); ++k) {
    arc_m_[k] = arc_m_[k - 1] + (path_.waypoints[k] - path_.waypoints[k - 1]).norm();
  }
  final_heading_rad_ = final_heading_rad;
  reached_m_ = 0.0;
  tight_until_m_ = 0.0;
  rotating_ = false;
  at_goal_ = false;
  blocked_since_.reset();
  progress_at_ = now;
  best_remaining_m_ = std::numeric_limits<double>::infinity();
  best_error_rad_ = std::numeric_limits<double>::infinity();
}

void PathFollower::replace_path(Path path, RobotTime now) {
  const bool same_path = path.length_m < best_remaining_m_ + kAnotherPath_m;
  const auto blocked_since = blocked_since_;
  const RobotTime progress_at = progress_at_;
  const double best_remaining_m = best_remaining_m_;
  const double best_error_rad = best_error_rad_;
  const bool turning = rotating_;
  const double tight_m = std::max(0.0, tight_until_m_ - reached_m_);
  set_path(std::move(path), now, final_heading_rad_);
  rotating_ = turning;
  tight_until_m_ = tight_m;
  if (same_path) {
    blocked_since_ = blocked_since;
    progress_at_ = progress_at;
    best_remaining_m_ = best_remaining_m;
    best_error_rad_ = best_error_rad;
  }
}

void PathFollower::set_heading(const Pose2& map_T_base, double heading_rad, RobotTime now) {
  set_path(Path{{map_T_base.translation()}, 0.0, 0.0}, now, heading_rad);
  at_goal_ = true;
}

void PathFollower::transform(const MapMove& move) {
  if (final_heading_rad_ && !path_.waypoints.empty()) {
    final_heading_rad_ = wrap_angle(*final_heading_rad_ + move.at(path_.waypoints.back()).theta_rad);
  }
  for (Point2& p : path_.waypoints) {
    p = move * p;
  }
}

void PathFollower::clear() { set_path(Path{}, RobotTime{}); }

double PathFollower::braking_m() const {
  return command_.v_m_s * command_.v_m_s / (2.0 * kBrakeShare * params_.accel_m_s2);
}

Point2 PathFollower::point_at(double along_m) const {
  const auto after = std::upper_bound(arc_m_.begin(), arc_m_.end(), along_m);
  if (after == arc_m_.begin()) {
    return path_.waypoints.front();
  }
  if (after == arc_m_.end()) {
    return path_.waypoints.back();
  }
  const auto k = static_cast<std::size_t>(after - arc_m_.begin());
  const double t = (along_m - arc_m_[k - 1]) / (arc_m_[k] - arc_m_[k - 1]);
  return path_.waypoints[k - 1] + t * (path_.waypoints[k] - path_.waypoints[k - 1]);
}

PathFollower::Target PathFollower::find_target(const Point2& p_map) {
  double best_m = (p_map - point_at(reached_m_)).norm();
  double along_m = reached_m_;
  for (std::size_t k = 1; k < arc_m_.size(); ++k) {
    if (arc_m_[k] < reached_m_ - kWindowBack_m || arc_m_[k - 1] > reached_m_ + kWindowAhead_m) {
      continue;
    }
    const Point2 nearest = nearest_on_segment(path_.waypoints[k - 1], path_.waypoints[k], p_map);
    const double d = (p_map - nearest).norm();
    if (d < best_m) {
      best_m = d;
      along_m = arc_m_[k - 1] + (nearest - path_.waypoints[k - 1]).norm();
    }
  }
  reached_m_ = along_m;
  // The point aimed at is nearer where the straight segment to it would cut a corner.
  double aim_m = std::min(along_m + (tight() ? params_.min_lookahead_m : params_.lookahead_m), arc_m_.back());
  const auto cuts_corner = [&] {
    for (std::size_t k = 0; k < arc_m_.size(); ++k) {
      if (arc_m_[k] > along_m && arc_m_[k] < aim_m &&
          distance_to_segment_m(p_map, point_at(aim_m), path_.waypoints[k]) > params_.path_deviation_m) {
        return true;
      }
    }
    return false;
  };
  while (aim_m > along_m + params_.min_lookahead_m && cuts_corner()) {
    aim_m -= kLookaheadStep_m;
  }
  return {point_at(aim_m), arc_m_.back() - along_m + best_m, along_m};
}

double PathFollower::corner_speed(double along_m) const {
  double allowed = params_.max_v_m_s;
  for (std::size_t k = 1; k + 1 < arc_m_.size(); ++k) {
    if (arc_m_[k] <= along_m) {
      continue;
    }
    const Point2 in = path_.waypoints[k] - path_.waypoints[k - 1];
    const Point2 out = path_.waypoints[k + 1] - path_.waypoints[k];
    const double corner_rad = std::abs(wrap_angle(std::atan2(out.y(), out.x()) - std::atan2(in.y(), in.x())));
    const double through = params_.max_v_m_s * std::max(0.0, 1.0 - corner_rad / params_.rotate_in_place_rad);
    const double brake = 2.0 * kBrakeShare * params_.accel_m_s2 * (arc_m_[k] - along_m);
    allowed = std::min(allowed, std::sqrt(through * through + brake));
  }
  return allowed;
}

Twist2 PathFollower::rotate_towards(double error_rad) const {
  const double stoppable = std::sqrt(2.0 * kBrakeShare * params_.alpha_rad_s2 * std::abs(error_rad));
  const double speed = std::min({params_.heading_gain_1_s * std::abs(error_rad), stoppable, params_.max_omega_rad_s});
  return {0.0, std::copysign(speed, error_rad)};
}

Twist2 PathFollower::desired(const Pose2& map_T_base, const Target& target) {
  const double error_rad = bearing_to(map_T_base, target.p_map);
  const double start_rad = tight() ? params_.rotate_done_rad : params_.rotate_in_place_rad;
  const double done_rad = tight() ? params_.heading_tolerance_rad : params_.rotate_done_rad;
  const double limit_rad = rotating_ ? done_rad : start_rad;
  rotating_ = std::abs(error_rad) > limit_rad;
  if (rotating_) {
    return rotate_towards(error_rad);
  }
  const double chord_m = std::max((target.p_map - map_T_base.translation()).norm(), params_.goal_tolerance_m / 2.0);
  const double curvature = 2.0 * std::sin(error_rad) / chord_m;
  double v = std::min(params_.max_v_m_s, corner_speed(target.along_m));
  v = std::min(v, std::sqrt(2.0 * kBrakeShare * params_.accel_m_s2 * target.remaining_m));
  v = std::min(v, params_.max_omega_rad_s / std::max(std::abs(curvature), 1e-6));
  v = std::max(v, params_.min_v_m_s);
  return {v, std::clamp(v * curvature, -params_.max_omega_rad_s, params_.max_omega_rad_s)};
}

/// No room: a curve towards a point farther ahead cuts a corner that the path itself leads around.
void PathFollower::follow_closely(const Pose2& map_T_base) {
  tight_until_m_ = reached_m_ + kTight_m;
  const Point2 aim_map = find_target(map_T_base.translation()).p_map;
  rotating_ = std::abs(bearing_to(map_T_base, aim_map)) > params_.heading_tolerance_rad;
}

Twist2 PathFollower::smooth(const Twist2& wanted, double dt_s) const {
  return {approach(command_.v_m_s, wanted.v_m_s, params_.accel_m_s2 * dt_s),
          approach(command_.omega_rad_s, wanted.omega_rad_s, params_.alpha_rad_s2 * dt_s)};
}

/// The base stands before a contact, and is slow where it will come near to one.
Twist2 PathFollower::limit_for_room(const Twist2& wanted, const std::vector<Point2>& points_base) const {
  const Twist2 clear = limit_for_clearance(wanted, points_base, params_.clearance);
  ClearanceParams wide = params_.clearance;
  wide.radius_m += params_.near_miss_m;
  const double with_room_m_s = limit_for_clearance(wanted, points_base, wide).v_m_s;
  const double v_m_s = std::min(clear.v_m_s, std::max(with_room_m_s, params_.near_miss_v_m_s));
  return clear.v_m_s > 0.0 ? Twist2{v_m_s, clear.omega_rad_s * v_m_s / clear.v_m_s} : clear;
}

void PathFollower::roll(double ordered_m_s, double dt_s) {
  rolling_m_s_ = std::max(ordered_m_s, rolling_m_s_ - params_.clearance.decel_m_s2 * dt_s);
}

/// Orders what comes nearest to the wanted velocity and touches nothing, though the base rolls on for a while.
void PathFollower::command(const Twist2& wanted, const std::vector<Point2>& points_base, double dt_s) {
  const Twist2 allowed = limit_for_room(smooth(wanted, dt_s), points_base);
  roll(allowed.v_m_s, dt_s);
  command_ = keep_arc_while_braking(allowed, {rolling_m_s_, command_.omega_rad_s}, points_base, params_.clearance);
}

bool PathFollower::path_blocked(const Pose2& map_T_base, const std::vector<Point2>& points_base, double along_m) const {
  const double end_m = std::min(along_m + params_.blocked_lookahead_m, arc_m_.back());
  std::vector<Point2> ahead{point_at(along_m)};
  for (std::size_t k = 0; k < arc_m_.size(); ++k) {
    if (arc_m_[k] > along_m && arc_m_[k] < end_m) {
      ahead.push_back(path_.waypoints[k]);
    }
  }
  ahead.push_back(point_at(end_m));
  const double reach_m = params_.blocked_lookahead_m + params_.blocked_radius_m;
  for (const Point2& p_base : points_base) {
    // What touches the footprint already is the clearance check's business: the path may lead away from it.
    if (p_base.norm() > reach_m || p_base.norm() < params_.clearance.radius_m) {
      continue;
    }
    const Point2 p_map = map_T_base * p_base;
    for (std::size_t k = 1; k < ahead.size(); ++k) {
      if (distance_to_segment_m(ahead[k - 1], ahead[k], p_map) < params_.blocked_radius_m) {
        return true;
      }
    }
  }
  return false;
}

bool PathFollower::stuck(double remaining_m, double error_rad, RobotTime now) {
  if (remaining_m < best_remaining_m_ - params_.progress_m) {
    best_remaining_m_ = remaining_m;
    best_error_rad_ = std::numeric_limits<double>::infinity();
    progress_at_ = now;
  }
  if (std::abs(error_rad) < best_error_rad_ - params_.progress_rad) {
    best_error_rad_ = std::abs(error_rad);
    progress_at_ = now;
  }
  return to_seconds(now - progress_at_) > params_.stuck_for_s;
}

std::optional<FollowStep> PathFollower::watch(const Pose2& map_T_base, const std::vector<Point2>& points_base,
                                              const Target& target, RobotTime now) {
  const bool no_room = !rotating_ && command_.v_m_s <= 0.0;
  if (no_room || path_blocked(map_T_base, points_base, target.along_m)) {
    blocked_since_ = blocked_since_.value_or(now);
    if (to_seconds(now - *blocked_since_) >= params_.blocked_for_s) {
      return FollowStep{{}, FollowState::kBlocked, target.remaining_m, "an obstacle lies on the path"};
    }
  } else {
    blocked_since_.reset();
  }
  if (stuck(target.remaining_m, bearing_to(map_T_base, target.p_map), now)) {
    return FollowStep{{}, FollowState::kStuck, target.remaining_m, "no progress towards the goal"};
  }
  return std::nullopt;
}

FollowStep PathFollower::finish(const Pose2& map_T_base, const Target& target, double dt_s, RobotTime now) {
  const double error_rad = final_heading_rad_ ? wrap_angle(*final_heading_rad_ - map_T_base.theta_rad) : 0.0;
  const bool aligned = std::abs(error_rad) <= params_.heading_tolerance_rad;
  command_ = smooth(aligned ? Twist2{} : rotate_towards(error_rad), dt_s);
  const bool standing = std::abs(command_.v_m_s) < kStanding_m_s && std::abs(command_.omega_rad_s) < kStanding_rad_s;
  if (aligned && standing) {
    command_ = {};
    return {command_, FollowState::kArrived, 0.0, ""};
  }
  if (stuck(0.0, error_rad, now)) {
    command_ = smooth({}, dt_s);
    return {command_, FollowState::kStuck, target.remaining_m, "the robot does not rotate to the requested heading"};
  }
  return {command_, FollowState::kFollowing, target.remaining_m, ""};
}

FollowStep PathFollower::step(const Pose2& map_T_base, const std::vector<Point2>& points_base, RobotTime now) {
  const double dt_s = last_step_ ? std::clamp(to_seconds(now - *last_step_), 0.0, kLongestStep_s) : kFirstStep_s;
  last_step_ = now;
  if (path_.empty() || !is_finite(map_T_base)) {
    command_ = smooth({}, dt_s);
    roll(command_.v_m_s, dt_s);
    const bool idle = path_.empty();
    return {command_, idle ? FollowState::kIdle : FollowState::kStuck, 0.0, idle ? "" : "the pose is not finite"};
  }
  const Target target = find_target(map_T_base.translation());
  at_goal_ = at_goal_ || target.remaining_m <= params_.goal_tolerance_m;
  if (at_goal_) {
    FollowStep done = finish(map_T_base, target, dt_s, now);
    command_ = limit_for_clearance(done.command, points_base, params_.clearance);
    roll(command_.v_m_s, dt_s);
    done.command = command_;
    return done;
  }
  const Twist2 wanted = desired(map_T_base, target);
  const Twist2 before = command_;
  const double rolling_before_m_s = rolling_m_s_;
  command(wanted, points_base, dt_s);
  if (!rotating_ && command_.v_m_s <= 0.0) {
    follow_closely(map_T_base);
  }
  if (auto problem = watch(map_T_base, points_base, target, now)) {
    command_ = before;
    rolling_m_s_ = rolling_before_m_s;
    command({}, points_base, dt_s);
    problem->command = command_;
    return *problem;
  }
  return {command_, FollowState::kFollowing, target.remaining_m, ""};
}

}  // namespace seeker::nav
