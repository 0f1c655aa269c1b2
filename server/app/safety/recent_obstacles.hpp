/// \file
/// Obstacles that the laser saw a moment ago and no longer looks at: behind the robot.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"

namespace seeker::app {

/// What was last seen around the robot, in each direction, in the frame of its odometry. No clock and no thread.
class RecentObstacles {
 public:
  /// How far from the robot obstacles are remembered: more than what it needs to stop.
  static constexpr double kReach_m = 1.5;
  /// How long: a wall does not go away, and whoever has can be looked for by turning.
  static constexpr Duration kKept = std::chrono::minutes(5);

  /// Takes in a scan that was made at `odom_T_base`. What lies where it looked is forgotten, whether seen again or not.
  void see(const LaserScan& scan, const Pose2& odom_T_base);
  /// Odometry has jumped: nothing is known any more.
  void forget() { cells_.clear(); }
  /// The obstacles in the frame `base` of a robot that is at `odom_T_base`.
  [[nodiscard]] std::vector<Point2> in_base(const Pose2& odom_T_base, RobotTime now) const;

 private:
  struct Seen {
    Point2 p_odom;
    RobotTime stamp;
  };
  /// Points of one cell of a square grid are one obstacle.
  using Cell = std::pair<std::int64_t, std::int64_t>;

  std::map<Cell, Seen> cells_;
};

}  // namespace seeker::app
