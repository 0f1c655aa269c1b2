#include "server/explore/wall_follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/polygon.hpp"
#include "server/explore/one_step.hpp"

namespace seeker::explore {
namespace {

/// Half the heading's error counts as much as the distance's (spec S1.12, step 3).
constexpr double kHeadingWeight_m_rad = 0.5;
constexpr double kProgress_1 = 0.1;  ///< worth of a metre of path length, so that of equal controls the faster one wins
constexpr double kRotation_rad = 0.35;  ///< beyond this heading error, rotate on the spot where no arc helps
constexpr double kBefore_m = 0.1;       ///< so far before a wall the robot is on its free side
constexpr double kPast_m = 0.3;         ///< so far beyond an open end there is nothing that continues the wall
constexpr int kMaxSwitches = 8;
constexpr std::size_t kPlaces = 10;  ///< so many decisions
constexpr double kNowhere_m = 0.3;   ///< within this: stuck
constexpr double kLapBegun = 2.0;    ///< so many times the switching distance from its start the robot is on its lap

Pose2 in_segment(const MapSegment& segment, const Pose2& map_T_base) {
  return inverse(segment.map_T_segment) * map_T_base;
}

/// From the robot to the end ahead, along the wall; negative: it is past it.
double to_end_m(const MapSegment& segment, WallSide side, const Pose2& map_T_base) {
  return 0.5 * segment.length_m - sign_of(side) * in_segment(segment, map_T_base).x_m;
}

}  // namespace

WallFollower::WallFollower(const OneStepParams& step, const WallParams& params) : step_(step), params_(params) {}

bool WallFollower::start(const Pose2& map_T_base, const std::vector<MapSegment>& segments) {
  places_.clear();
  followed_ = 0;
  const auto nearest = find_followed(map_T_base, segments);
  if (!nearest) {
    return false;
  }
  const double along_m = in_segment(segments[*nearest], map_T_base).x_m;
  const auto left = route_to_open_end(segments, *nearest, along_m, WallSide::kLeft, params_.adjacency_m);
  const auto right = route_to_open_end(segments, *nearest, along_m, WallSide::kRight, params_.adjacency_m);
  if (!left && !right && !params_.whole_lap) {
    return false;
  }
  side_ = right && (!left || right->cost_m < left->cost_m) ? WallSide::kRight : WallSide::kLeft;
  followed_ = segments[*nearest].id;
  lap_start_map_.reset();
  lap_begun_ = false;
  return true;
}

/// The one followed so far; where the map has changed, the nearest one that the robot stands before.
std::optional<std::size_t> WallFollower::find_followed(const Pose2& map_T_base,
                                                       const std::vector<MapSegment>& segments) const {
  std::optional<std::size_t> nearest;
  double nearest_m = params_.max_offset_m;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    if (segments[k].id == followed_) {
      return k;
    }
    const Pose2 place = in_segment(segments[k], map_T_base);
    const bool before = place.y_m < 0.0 && std::abs(place.x_m) <= 0.5 * segments[k].length_m;
    if (before && -place.y_m < nearest_m) {
      nearest = k;
      nearest_m = -place.y_m;
    }
  }
  return nearest;
}

std::optional<std::size_t> WallFollower::next_segment(const Pose2& map_T_base, const std::vector<MapSegment>& segments,
                                                      std::size_t followed) const {
  const double along_m = in_segment(segments[followed], map_T_base).x_m;
  const auto route = route_to_open_end(segments, followed, along_m, side_, params_.adjacency_m);
  const auto next = route && route->segments.size() > 1
                        ? std::optional(route->segments[1])
                        : adjacent_segment(segments, followed, side_, params_.adjacency_m);
  // Round a door post the wall goes on behind the robot's back: its line is not to be headed for through the post.
  const bool behind = next && in_segment(segments[*next], map_T_base).y_m > -kBefore_m;
  return params_.whole_lap && behind ? std::nullopt : next;
}

/// Step 2: near the end ahead the next wall is followed.
std::size_t WallFollower::switch_segment(const Pose2& map_T_base, const std::vector<MapSegment>& segments,
                                         std::size_t followed) const {
  for (int k = 0; k < kMaxSwitches; ++k) {
    const double left_m = to_end_m(segments[followed], side_, map_T_base);
    if (left_m > params_.switch_m || (!params_.whole_lap && !is_real(segments[followed], side_))) {
      return followed;
    }
    const auto next = next_segment(map_T_base, segments, followed);
    if (!next) {
      return followed;
    }
    followed = *next;
  }
  return followed;
}

WallFollower::Track WallFollower::track_of(const Pose2& map_T_base, const std::vector<MapSegment>& segments,
                                           std::size_t followed) const {
  const MapSegment& wall = segments[followed];
  const Pose2 along{0.0, 0.0, side_ == WallSide::kLeft ? kPi : 0.0};
  Track track{wall.map_T_segment * Pose2{0.0, -params_.distance_m, 0.0} * along, std::nullopt};
  if (!ends_loose(map_T_base, segments, followed) || to_end_m(wall, side_, map_T_base) > 0.0) {
    return track;
  }
  // Round the end: the tangent of a circle about it, at the robot's bearing; the end stays on the wall's hand.
  const Point2 end = end_of(wall, side_);
  const Point2 out = map_T_base.translation() - end;
  const double bearing_rad = std::atan2(out.y(), out.x());
  const double rotation_rad = side_ == WallSide::kLeft ? -kPi / 2.0 : kPi / 2.0;
  const Point2 foot = end + params_.distance_m * Point2(std::cos(bearing_rad), std::sin(bearing_rad));
  track.map_T_line = {foot.x(), foot.y(), bearing_rad + rotation_rad};
  track.pivot_map = end;
  return track;
}

double WallFollower::heading_error_rad(const Track& track, const Pose2& map_T_base) const {
  const Pose2 place = inverse(track.map_T_line) * map_T_base;
  const double to_line_rad = params_.ahead_m > 0.0 ? std::atan2(place.y_m, params_.ahead_m) : 0.0;
  return wrap_angle(place.theta_rad + to_line_rad);
}

double WallFollower::error(const Track& track, const Pose2& map_T_base) const {
  const double off_m = track.pivot_map ? (map_T_base.translation() - *track.pivot_map).norm() - params_.distance_m
                                       : (inverse(track.map_T_line) * map_T_base).y_m;
  return std::abs(off_m) + kHeadingWeight_m_rad * std::abs(heading_error_rad(track, map_T_base));
}

void WallFollower::choose_control(const Track& track, const Pose2& map_T_base, const ControlCheck& check,
                                  WallChoice& choice) const {
  const double now_error = error(track, map_T_base);
  for (const Twist2& control : controls_of(step_)) {
    DecisionCandidate candidate;
    candidate.control = control;
    candidate.map_T_base = map_T_base * integrate(control, step_.observation_period_s);
    candidate.path_m = std::abs(control.v_m_s) * step_.observation_period_s;
    candidate.refused = check.refusal(control, step_.observation_period_s);
    Track there = track;
    if (track.pivot_map) {  // the tangent rotates with the robot
      const Point2 out = candidate.map_T_base.translation() - *track.pivot_map;
      const double rotation_rad = side_ == WallSide::kLeft ? -kPi / 2.0 : kPi / 2.0;
      const Point2 foot = *track.pivot_map + params_.distance_m * out.normalized();
      there.map_T_line = {foot.x(), foot.y(), std::atan2(out.y(), out.x()) + rotation_rad};
    }
    const double progress_m =
        (inverse(track.map_T_line) * candidate.map_T_base).x_m - (inverse(track.map_T_line) * map_T_base).x_m;
    candidate.score = -error(there, candidate.map_T_base) + kProgress_1 * progress_m;
    choice.decision.candidates.push_back(candidate);
  }
  const bool pointing_off = std::abs(heading_error_rad(track, map_T_base)) > kRotation_rad;
  const double rotation_sign = heading_error_rad(track, map_T_base) > 0.0 ? -1.0 : 1.0;
  for (std::uint32_t k = 0; k < choice.decision.candidates.size(); ++k) {
    const DecisionCandidate& candidate = choice.decision.candidates[k];
    const auto& chosen = choice.decision.chosen;
    const bool rotates = candidate.control.v_m_s == 0.0;
    // Arcs must reduce the heading error (or keep it small); rotation must be towards the path.
    const bool helps = rotates ? candidate.control.omega_rad_s * rotation_sign > 0.0
                               : -candidate.score < (pointing_off ? now_error : std::max(now_error, kRotation_rad));
    if (candidate.refused.empty() && helps &&
        (!chosen || candidate.score > choice.decision.candidates[*chosen].score)) {
      choice.decision.chosen = k;
    }
  }
}

bool WallFollower::gets_nowhere(const Pose2& map_T_base) {
  places_.push_back(map_T_base.translation());
  if (places_.size() <= kPlaces) {
    return false;
  }
  places_.erase(places_.begin());
  return std::all_of(places_.begin(), places_.end(),
                     [&](const Point2& p) { return (p - places_.back()).norm() < kNowhere_m; });
}

bool WallFollower::ends_loose(const Pose2& map_T_base, const std::vector<MapSegment>& segments,
                              std::size_t followed) const {
  const bool ends = params_.whole_lap || is_real(segments[followed], side_);
  return ends && !next_segment(map_T_base, segments, followed);
}

bool WallFollower::lap_is_over(const Pose2& map_T_base, const MapSegment& followed) {
  const double off_line_m = std::abs(in_segment(followed, map_T_base).y_m + params_.distance_m);
  if (!lap_start_map_ && off_line_m > params_.switch_m) {
    return false;  // still on its way to the wall
  }
  lap_start_map_ = lap_start_map_.value_or(map_T_base.translation());
  const double from_start_m = (map_T_base.translation() - *lap_start_map_).norm();
  lap_begun_ = lap_begun_ || from_start_m > kLapBegun * params_.switch_m;
  return lap_begun_ && from_start_m <= params_.switch_m;
}

std::string WallFollower::end_of_path(const Pose2& map_T_base, const std::vector<MapSegment>& segments,
                                      std::size_t followed, const std::optional<WallRoute>& route) {
  if (params_.whole_lap) {
    return lap_is_over(map_T_base, segments[followed]) ? "one lap along the walls has shown nothing new" : "";
  }
  if (!route && !ends_loose(map_T_base, segments, followed)) {
    return "the walls lead to no open end";
  }
  const MapSegment& wall = segments[followed];
  if (!is_real(wall, side_) && to_end_m(wall, side_, map_T_base) < -kPast_m) {
    return "the open end was passed and the wall does not go on";
  }
  return gets_nowhere(map_T_base) ? "the robot gets no farther along the wall" : "";
}

WallChoice WallFollower::decide(const Pose2& map_T_base, const std::vector<MapSegment>& segments,
                                const ControlCheck& check) {
  WallChoice choice;
  choice.decision.rule = "wall";
  const auto known = find_followed(map_T_base, segments);
  if (!known) {
    choice.failure = "the wall that was followed is gone";
    return choice;
  }
  const std::size_t followed = switch_segment(map_T_base, segments, *known);
  followed_ = segments[followed].id;
  const double along_m = in_segment(segments[followed], map_T_base).x_m;
  const auto route = route_to_open_end(segments, followed, along_m, side_, params_.adjacency_m);
  if (route) {
    choice.goal_map = end_of(segments[route->segments.back()], side_);
  }
  choice.failure = end_of_path(map_T_base, segments, followed, route);
  if (!choice.failure.empty()) {
    return choice;
  }
  choose_control(track_of(map_T_base, segments, followed), map_T_base, check, choice);
  if (choice.decision.chosen) {
    choice.control = choice.decision.candidates[*choice.decision.chosen].control;
    choice.decision.why = std::string("along the wall on the ") + (side_ == WallSide::kLeft ? "right" : "left") +
                          (route ? " to its open end" : ", which ends nowhere");
  } else {
    choice.failure = "no control may be held along the wall";
  }
  return choice;
}

}  // namespace seeker::explore
