/// \file
/// Collision check of a commanded velocity against the obstacle points that the sensors see now: pure functions,
/// used by the path follower and by the safety supervisor.
#pragma once

#include <vector>

#include "common/core/pose2.hpp"

namespace seeker::nav {

/// Circular footprint and braking of the base.
struct ClearanceParams {
  double radius_m = 0.26;       ///< radius of the circle around the base that must stay free of obstacle points
  double slow_margin_m = 0.03;  ///< extra room kept in front, beyond the stopping distance
  double decel_m_s2 = 0.3;      ///< deceleration when the base brakes (default: Pioneer 3-DX)
  double reaction_s = 0.2;      ///< delay from the sensor reading to the start of braking
  double horizon_m = 3.0;       ///< points farther along the arc than this are ignored
  double self_radius_m = 0.10;  ///< points nearer to the base's centre than this are the robot itself
};

/// Distance that the base may travel along the arc of `twist` before its footprint touches the first obstacle point;
/// horizon_m when it touches none. A point that lies inside the footprint already counts only when the motion would
/// bring it nearer. Rotation in place of a circular footprint touches no point.
[[nodiscard]] double free_arc_m(const Twist2& twist, const std::vector<Point2>& points_base,
                                const ClearanceParams& params);

/// The same arc, slowed so that the base can halt before contact: v is at most what allows stopping within the free
/// distance, and omega is reduced in proportion. With no room at all v is zero and omega stays, because rotation in
/// place touches no obstacle and lets the robot leave. The result is never faster than `twist`, and no sign changes.
[[nodiscard]] Twist2 limit_for_clearance(const Twist2& twist, const std::vector<Point2>& points_base,
                                         const ClearanceParams& params = {});

/// What limit_for_clearance() allows a base at rest, made safe for a base that rolls at `present`. A base that is
/// commanded to slow down rolls on for a while but takes up the commanded rotation at once, so it drives a tighter arc
/// than the one that was checked. Where it would meet an obstacle before it stands, omega is reduced to the share that
/// leaves the longest free distance. v stays, and no sign changes.
[[nodiscard]] Twist2 limit_rotation_while_rolling(const Twist2& allowed, const Twist2& present,
                                                  const std::vector<Point2>& points_base,
                                                  const ClearanceParams& params);

/// `wanted` for a base that still rolls at `present` and cannot become as slow at once. Where it would meet an obstacle
/// on the wanted arc before it stands, its rotation is that between the wanted one and the present one, on whose arc it
/// was free so far, which leaves it room enough or else the most room. v stays.
[[nodiscard]] Twist2 keep_arc_while_braking(const Twist2& wanted, const Twist2& present,
                                            const std::vector<Point2>& points_base, const ClearanceParams& params);

/// `wanted`, slowed so far that the base comes to rest without contact whenever it is ordered to stand. Such a base
/// gives up its rotation at once and rolls straight on while it brakes, so that an arc around an obstacle ends in it.
/// The command may end after any part of the arc, and the base may still turn as at `present`, its velocity now. With
/// no room v is zero and omega stays. The result is never faster than `wanted`, and no sign changes.
[[nodiscard]] Twist2 limit_for_sudden_stop(const Twist2& wanted, const Twist2& present,
                                           const std::vector<Point2>& points_base, const ClearanceParams& params);

}  // namespace seeker::nav
