/// \file
/// Drives to one goal over planned paths, planning again when the way is blocked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/nav/path_follower.hpp"
#include "server/nav/planner.hpp"
#include "server/search/search_params.hpp"
#include "server/search/strategy.hpp"

namespace seeker::search {

enum class DriveState : std::uint8_t { kIdle, kDriving, kArrived, kFailed };

/// Answer of one control step of a drive.
struct DriveStep {
  Twist2 command;
  DriveState state = DriveState::kIdle;
  std::string reason;  ///< of kFailed
};

class PlannedDriver {
 public:
  explicit PlannedDriver(const PlanParams& params);

  /// Plans and starts; false when no way leads there now (reason()).
  bool start(const StrategyInput& input, const Point2& goal_map, std::optional<double> final_heading_rad = {});
  [[nodiscard]] DriveStep step(const StrategyInput& input);
  void stop();
  [[nodiscard]] const std::vector<Point2>& path() const { return follower_.path().waypoints; }
  [[nodiscard]] const Point2& goal() const { return goal_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  bool plan(const StrategyInput& input);
  [[nodiscard]] DriveStep plan_again(const StrategyInput& input, const std::string& why);

  PlanParams params_;
  nav::PathFollower follower_;
  Point2 goal_ = Point2::Zero();
  std::optional<double> final_heading_rad_;
  RobotTime started_;
  int failures_ = 0;
  bool driving_ = false;
  std::string reason_;
};

/// What lies around the robot now, in the base: laser returns, and near sonar echoes (things below the laser's plane).
[[nodiscard]] std::vector<Point2> obstacles_in_base(const StrategyInput& input);

}  // namespace seeker::search
