/// \file
/// Things that drive about as a laser sees them: others than those that tell of themselves.
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

/// A body that stands free before whatever is beside it.
struct FreeBody {
  Point2 centre;  ///< in the frame of the scan's base, or where the holder says
  double radius_m = 0.0;
  std::vector<Point2> surface;  ///< where beams end at it, in the same frame
};

/// Bodies as wide as robots are, frame `base`; what the edge of the scan cuts is none.
[[nodiscard]] std::vector<FreeBody> free_bodies(const LaserScan& scan);

/// A scan, and where it was taken.
struct ScanAt {
  Pose2 odom_T_base;
  LaserScan scan;

  /// Whether both beams beside the point end clearly behind it: nothing was there.
  [[nodiscard]] bool sees_through(const Point2& p_odom) const;
};

/// Follows such bodies from scan to scan by odometry, which over half a second is right to a centimetre. One drives if
/// it leaves free what it covered or covers what was free: of what stands, one may see another side from another place,
/// and its middle then moves, but nothing is ever seen through it.
class SeenMovers {
 public:
  void look(const LaserScan& scan, const Pose2& odom_T_base, RobotTime now);
  /// Those that drive on evenly, or have done so shortly before and are still in sight; brought on to the present,
  /// frame `base`.
  [[nodiscard]] std::vector<Mover> movers_base(const Pose2& odom_T_base, RobotTime now) const;

 private:
  struct Seen {
    RobotTime at;
    FreeBody body_odom;
  };
  struct Track {
    std::deque<Seen> seen;
    double radius_m = 0.0;  ///< the widest that was seen: what is half hidden is no smaller
    std::optional<RobotTime> drove_at;

    /// On average while it was followed.
    [[nodiscard]] Point2 velocity_odom() const;
    /// Evenly and fast, which where things stand in each other's way they may seem to do, too.
    [[nodiscard]] bool seems_to_drive() const;
  };

  void follow(FreeBody body_odom, RobotTime now);
  /// Over what it was followed; of the scans since then.
  [[nodiscard]] bool leaves_or_takes_free_space(const Track& track) const;

  std::vector<Track> tracks_;
  std::map<RobotTime, ScanAt> scans_;  ///< as long as one is followed
};

}  // namespace seeker::nav
