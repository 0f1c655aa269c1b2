#include "server/explore/control_check.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/polygon.hpp"

namespace seeker::explore {
namespace {

constexpr double kSample_m = 0.05;
/// Nearer by less than this is not nearer: readings are noisy.
constexpr double kNearer_m = 0.01;
/// The base needs this long to stop once the control ends.
constexpr double kStopping_s = 0.3;
constexpr double kFar_m = 1e3;

}  // namespace

ControlCheck::ControlCheck(const StrategyInput& input, const SightScene& scene, double radius_m, double longest_path_m,
                           bool use_floor)
    : map_T_base_(input.map_T_base), radius_m_(radius_m), areas_(input.floors.areas()) {
  if (const auto view = input.floors.view(); use_floor && view) {
    floor_ = *view;
  }
  const double reach_m = longest_path_m + 2.0 * radius_m;
  const Point2 here = map_T_base_.translation();
  for (const SightWall& wall : scene.walls()) {
    const Point2 left = wall.map_T_segment * Point2(-0.5 * wall.length_m, 0.0);
    const Point2 right = wall.map_T_segment * Point2(0.5 * wall.length_m, 0.0);
    if (distance_to_segment_m(left, right, here) < reach_m) {
      walls_.emplace_back(left, right);
    }
  }
  for (const Point2& p_base : nav::obstacles_in_base(input)) {
    if (p_base.norm() < reach_m) {
      points_map_.push_back(map_T_base_ * p_base);
    }
  }
}

double ControlCheck::distance_m(const Point2& p_map) const {
  double nearest_m = kFar_m;
  for (const auto& [left, right] : walls_) {
    nearest_m = std::min(nearest_m, distance_to_segment_m(left, right, p_map));
  }
  for (const Point2& point : points_map_) {
    nearest_m = std::min(nearest_m, (point - p_map).norm());
  }
  return nearest_m;
}

std::string ControlCheck::refusal(const Twist2& control, double tau_s) const {
  const double path_m = std::abs(control.v_m_s) * (tau_s + kStopping_s);
  if (path_m <= 0.0) {
    return {};
  }
  const Point2 here = map_T_base_.translation();
  const double limit_m = std::min(radius_m_, distance_m(here) - kNearer_m);
  // A robot that stands on ground of which nothing is known may leave it.
  bool on_floor = !floor_ || floor_->cost.traversable(here);
  const int samples = static_cast<int>(std::ceil(path_m / kSample_m));
  for (int k = 1; k <= samples; ++k) {
    const Point2 p = (map_T_base_ * integrate(control, (tau_s + kStopping_s) * k / samples)).translation();
    if (distance_m(p) < limit_m) {
      return "an obstacle is too near";
    }
    if (!areas_.allows(p) && areas_.allows(here)) {
      return "forbidden ground";
    }
    const bool traversable = !floor_ || floor_->cost.traversable(p);
    if (on_floor && !traversable) {
      return "the floor there is not known to be free";
    }
    on_floor = on_floor || traversable;
  }
  return on_floor ? "" : "the floor there is not known to be free";
}

}  // namespace seeker::explore
