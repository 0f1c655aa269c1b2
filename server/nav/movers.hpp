/// \file
/// Other robots whose places are told: they move, so that they are neither part of the map nor things that stand still.
#pragma once

#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "server/nav/clearance.hpp"

namespace seeker::nav {

/// A robot in a frame that the holder names.
struct Mover {
  Pose2 frame_T_base;
  Twist2 velocity;         ///< its own, at that place
  double radius_m = 0.26;  ///< of its body
  double slack_m = 0.0;    ///< so far from the told place it may be

  /// Within the body, wherever it may be.
  [[nodiscard]] bool may_cover(const Point2& p_frame) const;
};

[[nodiscard]] std::vector<Mover> moved(std::vector<Mover> movers, const Pose2& new_T_old);

/// The scan with the beams that end at a mover marked as unusable (quality 0): for whatever makes a map of it.
[[nodiscard]] LaserScan without_movers(LaserScan scan, const Pose2& map_T_base, const std::vector<Mover>& movers_map);

/// `wanted`, slowed along its arc so far that this robot and each mover, both braking from now on, come to rest apart:
/// clearances count with what stands still, and two that drive towards each other share the way between them. Where no
/// speed is safe, the one that keeps them farthest apart: driving on may be the way out. Movers that stand are left to
/// limit_for_clearance(). `present`: the robot's velocity now; `movers_base`: in its base. Never speeds up, never
/// changes a sign.
[[nodiscard]] Twist2 limit_for_movers(const Twist2& wanted, const Twist2& present,
                                      const std::vector<Mover>& movers_base, const ClearanceParams& params);

}  // namespace seeker::nav
