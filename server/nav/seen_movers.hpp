/// \file
/// Things that drive about as a laser sees them: others than those that tell of themselves.
#pragma once

#include <deque>
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
};

/// Bodies as wide as robots are, frame `base`; what the edge of the scan cuts is none.
[[nodiscard]] std::vector<FreeBody> free_bodies(const LaserScan& scan);

/// Follows such bodies from scan to scan by odometry, which over half a second is right to a centimetre.
class SeenMovers {
 public:
  void look(const LaserScan& scan, const Pose2& odom_T_base, RobotTime now);
  /// Those that drive on evenly, or have done so shortly before and are still in sight; brought on to the present,
  /// frame `base`.
  [[nodiscard]] std::vector<Mover> movers_base(const Pose2& odom_T_base, RobotTime now) const;

 private:
  struct Seen {
    RobotTime at;
    Point2 p_odom;
  };
  struct Track {
    std::deque<Seen> seen;
    double radius_m = 0.0;  ///< the widest that was seen: what is half hidden is no smaller
    std::optional<RobotTime> drove_at;

    /// On average while it was followed.
    [[nodiscard]] Point2 velocity_odom() const;
    /// Nothing else moves as evenly and as fast.
    [[nodiscard]] bool surely_drives() const;
  };

  void follow(const FreeBody& body_odom, RobotTime now);

  std::vector<Track> tracks_;
};

}  // namespace seeker::nav
