/// \file
/// Areas that a mission forbids the robot to enter.
#pragma once

#include <optional>
#include <vector>

#include "common/core/polygon.hpp"
#include "common/core/pose2.hpp"
#include "common/core/unreachable.hpp"

namespace seeker::nav {

/// Where the robot must not go: outside `bound` and inside any of `keep_out`, frame `map`.
struct ForbiddenAreas {
  std::optional<Polygon> bound;
  std::vector<Polygon> keep_out;

  [[nodiscard]] bool outside_bound(const Point2& p_map) const;
  [[nodiscard]] bool in_keep_out(const Point2& p_map) const;
  [[nodiscard]] bool allows(const Point2& p_map) const { return !outside_bound(p_map) && !in_keep_out(p_map); }
  [[nodiscard]] bool empty() const { return !bound && keep_out.empty(); }
  /// Why a robot at this place that has no floor around it to drive on cannot set out: for the areas, or for obstacles.
  [[nodiscard]] UnreachableCause cause_of_no_floor(const Point2& p_map) const {
    return allows(p_map) ? UnreachableCause::kRobotEnclosed : UnreachableCause::kRobotForbidden;
  }
};

/// Distance along a ray to the first border that leads from allowed to forbidden ground. Nothing: there is none within
/// `max_m`.
[[nodiscard]] std::optional<double> distance_to_forbidden(const ForbiddenAreas& areas, const Point2& from_map,
                                                          double direction_rad, double max_m);

}  // namespace seeker::nav
