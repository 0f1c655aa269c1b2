/// \file
/// Follows a path with velocity commands that the base can execute.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/nav/clearance.hpp"
#include "server/nav/planner.hpp"

namespace seeker::nav {

enum class FollowState : std::uint8_t {
  kIdle,       ///< there is no path
  kFollowing,  ///< the robot drives along the path
  kArrived,    ///< within the tolerance of the goal (and of the final heading, when one was asked for)
  kBlocked,    ///< an obstacle lies on the path now; plan again
  kStuck,      ///< no progress for too long; plan again or give the goal up
};

struct FollowerParams {
  double max_v_m_s = 0.5;
  double max_omega_rad_s = 1.2;
  double accel_m_s2 = 0.3;           ///< acceleration limit (default: Pioneer 3-DX)
  double alpha_rad_s2 = 1.745;       ///< angular acceleration limit; 100 deg/s2
  double lookahead_m = 0.45;         ///< pure pursuit: distance along the path from the robot to the point aimed at
  double rotate_in_place_rad = 0.6;  ///< heading error beyond which the robot stops and rotates in place
  double rotate_done_rad = 0.15;     ///< heading error below which it drives on
  double heading_gain_1_s = 2.0;     ///< rotation speed per heading error
  double goal_tolerance_m = 0.10;
  double heading_tolerance_rad = 0.05;  ///< tolerance of the final heading
  double min_v_m_s = 0.05;              ///< slowest useful speed, below which the base would creep
  double blocked_lookahead_m = 1.0;     ///< distance ahead along the path within which obstacles count
  double blocked_radius_m = 0.20;       ///< a point nearer than this to the path blocks it
  double path_deviation_m = 0.06;       ///< largest distance from the path when corners are cut
  double min_lookahead_m = 0.15;
  /// An obstacle must block the path for this time, so that a person walking by causes no replanning.
  double blocked_for_s = 0.6;
  double stuck_for_s = 6.0;  ///< time without progress after which the robot is stuck
  double progress_m = 0.05;  ///< smallest decrease of the remaining path length that counts as progress
  /// Smallest decrease of the heading error that counts as progress while rotating in place.
  double progress_rad = 0.1;
  /// Obstacles that the footprint would pass at less than this are passed slowly, so that errors of the pose and of the
  /// wheels end in no contact.
  double near_miss_m = 0.05;
  double near_miss_v_m_s = 0.2;  ///< speed at which they are passed
  ClearanceParams clearance;
};

/// Result of one control step.
struct FollowStep {
  Twist2 command;
  FollowState state = FollowState::kIdle;
  double remaining_m = 0.0;  ///< remaining length of the path
  std::string reason;        ///< cause of kBlocked or kStuck; else empty
};

/// Follows one path at a time. The robot rotates in place when its heading is far off; otherwise pure pursuit sets the
/// rotation speed, with the speed limited by curvature, clearance and remaining distance. Commands change by at most
/// the acceleration limits, except that an obstacle may cause harder braking.
class PathFollower {
 public:
  explicit PathFollower(const FollowerParams& params = {});

  /// Starts a path. At its end the robot rotates to `final_heading_rad` (frame `map`) when given. The commanded
  /// velocity of the previous path is kept.
  void set_path(Path path, RobotTime now, std::optional<double> final_heading_rad = std::nullopt);
  /// Replaces the path by a new one to the same goal while it is driven. The records of progress and of blocking
  /// obstacles are kept, unless the new path is longer than what was left of the old one.
  void replace_path(Path path, RobotTime now);
  /// Starts a rotation in place to a heading in the frame `map`.
  void set_heading(const Pose2& map_T_base, double heading_rad, RobotTime now);
  /// The map was corrected: the rest of the path moves with it, as does the final heading.
  void transform(const MapMove& move);
  void clear();
  [[nodiscard]] bool active() const { return !path_.empty(); }
  /// Whether the end of the path is reached and only stopping or the rotation to the final heading is left.
  [[nodiscard]] bool at_goal() const { return at_goal_; }
  [[nodiscard]] const Path& path() const { return path_; }
  /// Remaining length of the path at which the robot, as fast as it is commanded now, begins to brake for its end.
  [[nodiscard]] double braking_m() const;

  /// Computes one control step. `points_base` holds the obstacles seen now in the frame `base` (points_in_base(scan),
  /// sonar echoes); when it is empty, only the path counts. `now` must not decrease.
  [[nodiscard]] FollowStep step(const Pose2& map_T_base, const std::vector<Point2>& points_base, RobotTime now);

 private:
  struct Target {
    Point2 p_map;        ///< point aimed at
    double remaining_m;  ///< from the robot along the path to its end
    double along_m;      ///< arc length of the robot's projection
  };

  [[nodiscard]] Target find_target(const Point2& p_map);
  [[nodiscard]] Twist2 desired(const Pose2& map_T_base, const Target& target);
  [[nodiscard]] double corner_speed(double along_m) const;
  [[nodiscard]] Twist2 rotate_towards(double error_rad) const;
  [[nodiscard]] Twist2 smooth(const Twist2& wanted, double dt_s) const;
  [[nodiscard]] Twist2 limit_for_room(const Twist2& wanted, const std::vector<Point2>& points_base) const;
  void roll(double ordered_m_s, double dt_s);
  void command(const Twist2& wanted, const std::vector<Point2>& points_base, double dt_s);
  [[nodiscard]] bool path_blocked(const Pose2& map_T_base, const std::vector<Point2>& points_base,
                                  double along_m) const;
  [[nodiscard]] std::optional<FollowStep> watch(const Pose2& map_T_base, const std::vector<Point2>& points_base,
                                                const Target& target, RobotTime now);
  [[nodiscard]] FollowStep finish(const Pose2& map_T_base, const Target& target, double dt_s, RobotTime now);
  [[nodiscard]] Point2 point_at(double along_m) const;
  /// Whether the robot stays close to the path; see follow_closely().
  [[nodiscard]] bool tight() const { return reached_m_ < tight_until_m_; }
  void follow_closely(const Pose2& map_T_base);
  [[nodiscard]] bool stuck(double remaining_m, double error_rad, RobotTime now);

  FollowerParams params_;
  Path path_;
  std::vector<double> arc_m_;  ///< arc length at each waypoint
  std::optional<double> final_heading_rad_;
  Twist2 command_;
  double rolling_m_s_ = 0.0;  ///< speed of a base that is ordered `command_` and brakes as it can
  /// Farthest projection on the path so far, so that a path that crosses itself is followed completely.
  double reached_m_ = 0.0;
  /// Path length up to which the robot stays close to the path, because an obstacle had left no room to drive.
  double tight_until_m_ = 0.0;
  bool rotating_ = false;
  bool at_goal_ = false;
  std::optional<RobotTime> last_step_;
  std::optional<RobotTime> blocked_since_;
  RobotTime progress_at_;
  double best_remaining_m_ = 0.0;
  double best_error_rad_ = 0.0;
};

}  // namespace seeker::nav
