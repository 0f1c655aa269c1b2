/// \file
/// Turns a path into velocity commands that the base can follow.
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
  kIdle,       ///< no path
  kFollowing,  ///< on its way
  kArrived,    ///< within the tolerance of the goal (and of the final heading, when one was asked for)
  kBlocked,    ///< an obstacle lies on the path now: plan again
  kStuck,      ///< no progress for too long: plan again or give the goal up
};

struct FollowerParams {
  double max_v_m_s = 0.5;
  double max_omega_rad_s = 1.2;
  double accel_m_s2 = 0.3;         ///< Pioneer 3-DX
  double alpha_rad_s2 = 1.745;     ///< 100 deg/s2
  double lookahead_m = 0.45;       ///< pure pursuit: distance along the path to the point aimed at
  double turn_in_place_rad = 0.6;  ///< beyond this heading error stop and turn
  double turn_done_rad = 0.15;     ///< below it, drive on
  double heading_gain_1_s = 2.0;   ///< rotation speed per heading error
  double goal_tolerance_m = 0.10;
  double heading_tolerance_rad = 0.05;  ///< for a final heading
  double min_v_m_s = 0.05;              ///< slowest useful speed: below it the base would creep
  double blocked_lookahead_m = 1.0;     ///< how far ahead on the path obstacles count
  double blocked_radius_m = 0.20;       ///< a point nearer than this to the path blocks it
  double path_deviation_m = 0.06;       ///< corners may be cut by so much
  double min_lookahead_m = 0.15;
  double blocked_for_s = 0.6;  ///< for so long, so that a person walking by does not cause a replan
  double stuck_for_s = 6.0;    ///< no progress for so long
  double progress_m = 0.05;    ///< what counts as progress along the path
  double progress_rad = 0.1;   ///< what counts as progress while turning in place
  ClearanceParams clearance;
};

/// Answer of one control step.
struct FollowStep {
  Twist2 command;
  FollowState state = FollowState::kIdle;
  double remaining_m = 0.0;  ///< along the path
  std::string reason;        ///< why kBlocked or kStuck
};

/// Follows one path at a time: rotates in place when the heading is far off, else pure pursuit with the speed limited
/// by curvature, clearance and remaining distance. Commands change by at most the acceleration limits, except that an
/// obstacle may brake harder.
class PathFollower {
 public:
  explicit PathFollower(const FollowerParams& params = {});

  /// Starts a path; at its end the robot turns to `final_heading_rad` (frame `map`) when given. The velocity carries
  /// over from the path before.
  void set_path(Path path, RobotTime now, std::optional<double> final_heading_rad = std::nullopt);
  /// The way to the same goal was planned anew while it is driven: what was noted of the robot's progress and of what
  /// is in its way goes on, unless the new way is a longer one.
  void replace_path(Path path, RobotTime now);
  /// Turns in place to a heading in the frame `map`.
  void set_heading(const Pose2& map_T_base, double heading_rad, RobotTime now);
  /// The map moved: the rest of the path goes along, as does the heading at its end.
  void transform(const MapMove& move);
  void clear();
  [[nodiscard]] bool active() const { return !path_.empty(); }
  /// At the end of the path: what is left is to stop, or to turn to the final heading.
  [[nodiscard]] bool at_goal() const { return at_goal_; }
  [[nodiscard]] const Path& path() const { return path_; }

  /// One control step. `points_base`: obstacles now, in the frame `base` (points_in_base(scan), sonar echoes); empty
  /// when the robot is blind, then only the path counts. `now` must not run backwards.
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
  [[nodiscard]] Twist2 turn_towards(double error_rad) const;
  [[nodiscard]] Twist2 smooth(const Twist2& wanted, double dt_s) const;
  [[nodiscard]] bool path_blocked(const Pose2& map_T_base, const std::vector<Point2>& points_base,
                                  double along_m) const;
  [[nodiscard]] std::optional<FollowStep> watch(const Pose2& map_T_base, const std::vector<Point2>& points_base,
                                                const Target& target, RobotTime now);
  [[nodiscard]] FollowStep finish(const Pose2& map_T_base, const Target& target, double dt_s, RobotTime now);
  [[nodiscard]] Point2 point_at(double along_m) const;
  [[nodiscard]] bool stuck(double remaining_m, double error_rad, RobotTime now);

  FollowerParams params_;
  Path path_;
  std::vector<double> arc_m_;  ///< arc length at each waypoint
  std::optional<double> final_heading_rad_;
  Twist2 command_;
  double reached_m_ = 0.0;  ///< farthest projection so far: a path that crosses itself is not cut short
  bool turning_ = false;
  bool at_goal_ = false;
  std::optional<RobotTime> last_step_;
  std::optional<RobotTime> blocked_since_;
  RobotTime progress_at_;
  double best_remaining_m_ = 0.0;
  double best_error_rad_ = 0.0;
};

}  // namespace seeker::nav
