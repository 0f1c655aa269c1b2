/// \file
/// Drives to one goal over planned paths, planning again when the way is blocked.
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

/// What a drive needs to know at one control step.
struct DriveInput {
  RobotTime now;  ///< of the mission: stands still while something else moves the robot
  Pose2 map_T_base;
  const SonarScan* sonar = nullptr;
  const LaserScan* laser = nullptr;
  FloorSource& floors;
};

struct DriverParams {
  int max_failures = 2;        ///< ways that turned out blocked, without getting nearer, before a drive is given up
  double goal_time_s = 120.0;  ///< nor may a drive go on for so long without getting nearer to its goal
  FollowerParams follower;
  PlannerParams planner = {};
  /// Plans anew so often while it drives, for what the map shows by then; 0: only where the way is blocked. Needed
  /// where ways lead over floor that nobody has seen.
  double replan_period_s = 0.0;
  /// A robot so near to its goal when blocked has as good as arrived.
  double close_enough_m = 0.4;
};

/// The way that is left must have become shorter by so much than it ever was before for what failed on it to be
/// forgotten.
inline constexpr double kNearer_m = 0.5;

enum class DriveState : std::uint8_t { kIdle, kDriving, kArrived, kFailed };

/// Answer of one control step of a drive.
struct DriveStep {
  Twist2 command;
  DriveState state = DriveState::kIdle;
  std::string reason;        ///< of kFailed
  double remaining_m = 0.0;  ///< of kDriving: along the way
};

class PlannedDriver {
 public:
  explicit PlannedDriver(const DriverParams& params);

  /// Plans and starts; false when no way leads there now (reason()).
  bool start(const DriveInput& input, const Point2& goal_map, std::optional<double> final_heading_rad = {});
  [[nodiscard]] DriveStep step(const DriveInput& input);
  /// The map moved: the way that is left goes along with the robot.
  void transform(const MapMove& move);
  void stop();
  [[nodiscard]] const std::vector<Point2>& path() const { return follower_.path().waypoints; }
  [[nodiscard]] const Point2& goal() const { return goal_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  [[nodiscard]] Result<Path> way(const DriveInput& input) const;
  bool plan(const DriveInput& input);
  /// A way that could not be found leaves the present one: who is in the way may have gone on by then.
  void refresh(const DriveInput& input);
  [[nodiscard]] DriveStep plan_again(const DriveInput& input, const FollowStep& follow);

  DriverParams params_;
  PathFollower follower_;
  Point2 goal_ = Point2::Zero();
  std::optional<double> final_heading_rad_;
  RobotTime planned_;
  ProgressWatch drive_;  ///< of the whole drive: forgets its failures
  ProgressWatch way_;    ///< of the present way: a detour may be longer
  int failures_ = 0;     ///< in a row, without getting nearer
  bool driving_ = false;
  std::string reason_;
};

/// What lies around the robot now, in the base: laser returns, and near sonar echoes (things below the laser's plane).
[[nodiscard]] std::vector<Point2> obstacles_in_base(const DriveInput& input);

}  // namespace seeker::nav
