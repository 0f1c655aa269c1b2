/// \file
/// Drives to one goal over planned paths, planning again when the way is blocked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/nav/floor_view.hpp"
#include "server/nav/path_follower.hpp"
#include "server/nav/planner.hpp"

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
  int max_failures = 2;        ///< failed plans of a drive before it is given up
  double goal_time_s = 120.0;  ///< longest drive to one goal
  FollowerParams follower;
};

enum class DriveState : std::uint8_t { kIdle, kDriving, kArrived, kFailed };

/// Answer of one control step of a drive.
struct DriveStep {
  Twist2 command;
  DriveState state = DriveState::kIdle;
  std::string reason;  ///< of kFailed
};

class PlannedDriver {
 public:
  explicit PlannedDriver(const DriverParams& params);

  /// Plans and starts; false when no way leads there now (reason()).
  bool start(const DriveInput& input, const Point2& goal_map, std::optional<double> final_heading_rad = {});
  [[nodiscard]] DriveStep step(const DriveInput& input);
  /// The map moved: the way that is left goes along with the robot.
  void transform(const Pose2& new_T_old);
  void stop();
  [[nodiscard]] const std::vector<Point2>& path() const { return follower_.path().waypoints; }
  [[nodiscard]] const Point2& goal() const { return goal_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  bool plan(const DriveInput& input);
  [[nodiscard]] DriveStep plan_again(const DriveInput& input, const std::string& why);

  DriverParams params_;
  PathFollower follower_;
  Point2 goal_ = Point2::Zero();
  std::optional<double> final_heading_rad_;
  RobotTime started_;
  int failures_ = 0;
  bool driving_ = false;
  std::string reason_;
};

/// What lies around the robot now, in the base: laser returns, and near sonar echoes (things below the laser's plane).
[[nodiscard]] std::vector<Point2> obstacles_in_base(const DriveInput& input);

}  // namespace seeker::nav
