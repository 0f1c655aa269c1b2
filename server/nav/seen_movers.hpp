/// \file
/// Detection and tracking of moving robots in laser scans, for robots that do not report their poses.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/nav/movers.hpp"

namespace seeker::nav {

/// A body that stands in front of what is beside it, seen from the laser.
struct FreeBody {
  Point2 centre;  ///< in the base frame of the scan, or in the frame that the holder names
  double radius_m = 0.0;
  std::vector<Point2> surface;  ///< end points of the beams at the body, in the same frame
};

/// All bodies in the scan that are as wide as robots are, frame `base`. Bodies cut by the edge of the scan are left
/// out.
[[nodiscard]] std::vector<FreeBody> free_bodies(const LaserScan& scan);

/// A scan and the pose where it was taken.
struct ScanAt {
  Pose2 odom_T_base;
  LaserScan scan;

  /// Whether the beams on both sides of the point end clearly behind it, so that the point was free.
  [[nodiscard]] bool sees_through(const Point2& p_odom) const;
};

/// Follows such bodies from scan to scan by odometry, which is accurate to a centimetre over half a second. A body
/// moves if it frees space that it covered or covers space that was free. The centre of a standing body may shift too,
/// when the robot sees another side of it, but the scan never sees through it.
class SeenMovers {
 public:
  /// Adds a scan.
  void look(const LaserScan& scan, const Pose2& odom_T_base, RobotTime now);
  /// The bodies that drive evenly now, or have done so shortly before and are still in sight, predicted to the present,
  /// frame `base`.
  [[nodiscard]] std::vector<Mover> movers_base(const Pose2& odom_T_base, RobotTime now) const;

 private:
  struct Seen {
    RobotTime at;
    FreeBody body_odom;
  };
  struct Track {
    std::deque<Seen> seen;
    double radius_m = 0.0;  ///< the largest radius seen, because a body that is half hidden is no smaller
    std::optional<RobotTime> drove_at;

    /// Average velocity since tracking began, frame `odom`.
    [[nodiscard]] Point2 velocity_odom() const;
    /// Whether the motion is even and fast. Standing objects that hide each other may fulfil this too.
    [[nodiscard]] bool seems_to_drive() const;
  };

  void follow(FreeBody body_odom, RobotTime now);
  /// Whether scans since tracking began see through places that the body covered, or covered places that were seen
  /// through.
  [[nodiscard]] bool leaves_or_takes_free_space(const Track& track) const;

  std::vector<Track> tracks_;
  std::map<RobotTime, ScanAt> scans_;  ///< scans since the start of the oldest track
};

}  // namespace seeker::nav
