/// \file
/// Other robots whose poses are reported: they move, so they are neither part of the map nor standing obstacles.
#pragma once

#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "server/nav/clearance.hpp"

namespace seeker::nav {

/// Another robot, in a frame that the holder of the struct names.
struct Mover {
  Pose2 frame_T_base;
  Twist2 velocity;         ///< velocity in its own base frame at that pose
  double radius_m = 0.26;  ///< radius of its body
  double slack_m = 0.0;    ///< largest position error of the reported pose

  /// Whether the place may lie within its body, given the position error.
  [[nodiscard]] bool may_cover(const Point2& p_frame) const;
};

/// The same movers in another frame.
[[nodiscard]] std::vector<Mover> moved(std::vector<Mover> movers, const Pose2& new_T_old);

/// The scan with all beams that end at a mover marked as unusable (quality 0), for use in mapping.
[[nodiscard]] LaserScan without_movers(LaserScan scan, const Pose2& map_T_base, const std::vector<Mover>& movers_map);

/// `wanted`, slowed along its arc so far that this robot and each mover, both braking from now on, come to rest apart.
/// Clearances to standing obstacles count too, and two robots that drive towards each other share the distance between
/// them. Where no speed is safe, the result is the speed that keeps them farthest apart, which may be to drive on.
/// Movers at rest are left to limit_for_clearance(). `present` is the robot's velocity now; `movers_base` is in its
/// base frame. The result is never faster than `wanted`, and no sign changes.
[[nodiscard]] Twist2 limit_for_movers(const Twist2& wanted, const Twist2& present,
                                      const std::vector<Mover>& movers_base, const ClearanceParams& params);

}  // namespace seeker::nav
