/// \file
/// Collision check of a commanded velocity against what the sensors see now: pure functions for follower and
/// supervisor.
#pragma once

#include <vector>

#include "common/core/pose2.hpp"

namespace seeker::nav {

/// Circular footprint and braking of the base.
struct ClearanceParams {
  double radius_m = 0.26;       ///< footprint that must stay free of points
  double slow_margin_m = 0.03;  ///< extra room kept in front, beyond the stopping distance
  double decel_m_s2 = 0.3;      ///< what the base can brake with (Pioneer 3-DX)
  double reaction_s = 0.2;      ///< from the reading to the first braking
  double horizon_m = 3.0;       ///< points farther along the arc are ignored
  double self_radius_m = 0.10;  ///< nearer points are the robot itself
};

/// Distance the base may travel along the arc of `twist` before its footprint touches the first point; horizon_m when
/// it meets none. A point already inside the footprint counts only when the motion would bring it nearer. Rotation in
/// place of a circular footprint meets nothing.
[[nodiscard]] double free_arc_m(const Twist2& twist, const std::vector<Point2>& points_base,
                                const ClearanceParams& params);

/// The same arc, slowed so that the base can halt before contact: v <= what allows stopping within the free way,
/// omega in proportion. With no room at all v is zero and omega stays, since turning in place meets nothing and is the
/// way out. Never speeds up, never changes a sign.
[[nodiscard]] Twist2 limit_for_clearance(const Twist2& twist, const std::vector<Point2>& points_base,
                                         const ClearanceParams& params = {});

/// What limit_for_clearance() allows a base that stands, made safe for one that rolls at `present`: told to slow down
/// it rolls on for a while but turns as told at once, on a tighter arc than the one that was checked. Where it would
/// meet something before it stands, omega is lessened to what leaves it the most way. v stays; never changes a sign.
[[nodiscard]] Twist2 limit_turn_while_rolling(const Twist2& allowed, const Twist2& present,
                                              const std::vector<Point2>& points_base, const ClearanceParams& params);

}  // namespace seeker::nav
