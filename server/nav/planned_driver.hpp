/// \file
/// Drives to one goal over planned paths, and plans again when the path is blocked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/map_move.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/nav/floor_view.hpp"
#include "server/nav/path_follower.hpp"
#include "server/nav/planner.hpp"
#include "server/nav/progress_watch.hpp"

namespace seeker::nav {

/// The inputs of one control step of a drive.
struct DriveInput {
  RobotTime now;  ///< mission time: stands still while another behaviour moves the robot
  Pose2 map_T_base;
  const SonarScan* sonar = nullptr;
  const LaserScan* laser = nullptr;
  FloorSource& floors;
};

struct DriverParams {
  /// Paths that turned out blocked in a row, without progress towards the goal, before the drive is given up.
  int max_failures = 2;
  double goal_time_s = 120.0;  ///< longest time without progress towards the goal before the drive is given up
  FollowerParams follower;
  PlannerParams planner = {};
  /// Period of replanning while driving, with the map of that moment, in seconds; 0: plan only where the path is
  /// blocked. It is needed where paths lead over floor that no robot has observed.
  double replan_period_s = 0.0;
  /// A robot that is blocked within this distance of its goal has arrived.
  double close_enough_m = 0.4;
};

/// The remaining path length must fall this far below its previous minimum for earlier failures to be forgotten.
inline constexpr double kNearer_m = 0.5;

/// Why a drive failed: what a caller may branch on, and a sentence for people.
struct DriveFailure {
  UnreachableCause cause = UnreachableCause::kBlocked;
  std::string text;
};

enum class DriveState : std::uint8_t { kIdle, kDriving, kArrived, kFailed };

/// Result of one control step of a drive.
struct DriveStep {
  Twist2 command;
  DriveState state = DriveState::kIdle;
  std::string reason;                                   ///< cause of kFailed in words; else empty
  double remaining_m = 0.0;                             ///< remaining path length while kDriving
  UnreachableCause cause = UnreachableCause::kBlocked;  ///< cause of kFailed
};

class PlannedDriver {
 public:
  explicit PlannedDriver(const DriverParams& params);

  /// Plans and starts a drive; false when no path leads to the goal now (the cause is in reason()).
  bool start(const DriveInput& input, const Point2& goal_map, std::optional<double> final_heading_rad = {});
  /// Goes on to another goal behind the present one, which the robot passes without a stop where the path does not
  /// turn sharply there. False, with nothing changed, when no path leads on.
  bool go_on(const DriveInput& input, const Point2& next_goal_map, std::optional<double> final_heading_rad = {});
  [[nodiscard]] DriveStep step(const DriveInput& input);
  /// The map was corrected: the rest of the path moves with the robot.
  void transform(const MapMove& move);
  void stop();
  [[nodiscard]] const std::vector<Point2>& path() const { return follower_.path().waypoints; }
  /// Whether the goal behind which go_on() led still lies ahead.
  [[nodiscard]] bool passes_through() const { return through_.has_value(); }
  /// Whether less than `lead_s` is left before the robot begins to brake for the end of its path.
  [[nodiscard]] bool brakes_within(double lead_s, const DriveStep& step) const {
    return step.remaining_m <= follower_.braking_m() + step.command.v_m_s * lead_s + params_.follower.goal_tolerance_m;
  }
  [[nodiscard]] const Point2& goal() const { return goal_; }
  [[nodiscard]] const std::string& reason() const { return failure_.text; }
  /// Of the last plan that failed.
  [[nodiscard]] const DriveFailure& failure() const { return failure_; }

 private:
  /// A place that the path leads through.
  struct Through {
    Point2 p_map;
    double beyond_m = 0.0;  ///< length of the path behind it
  };
  /// To the goal; also through the place that the path leads through, whose distance to the goal it notes.
  [[nodiscard]] Result<Path> find_path(const DriveInput& input);
  [[nodiscard]] Result<Path> find_leg(const DriveInput& input, const Point2& from_map, const Point2& to_map) const;
  bool plan(const DriveInput& input);
  void take(Path path, RobotTime now);
  [[nodiscard]] UnreachableCause cause_of_failure(const DriveInput& input) const;
  /// Replans while driving. If no path is found the present one is kept: whoever blocks it may have moved on by then.
  void refresh(const DriveInput& input);
  [[nodiscard]] DriveStep plan_again(const DriveInput& input, const FollowStep& follow);

  DriverParams params_;
  PathFollower follower_;
  Point2 goal_ = Point2::Zero();
  std::optional<Through> through_;
  std::optional<double> final_heading_rad_;
  RobotTime planned_;
  ProgressWatch drive_progress_;  ///< progress of the whole drive; progress forgets its failures
  ProgressWatch path_progress_;   ///< progress on the present path, which may be longer after a detour
  int failures_ = 0;              ///< failures in a row, without progress towards the goal
  bool driving_ = false;
  DriveFailure failure_;
};

/// The obstacle points around the robot now, frame `base`: laser returns, and near sonar echoes (objects below the
/// laser's plane).
[[nodiscard]] std::vector<Point2> obstacles_in_base(const DriveInput& input);

}  // namespace seeker::nav
