/// \file
/// A drive that does not give up at once: what blocks the way may be people who move on.
#pragma once

#include <string>

#include "server/nav/planned_driver.hpp"

namespace seeker::nav {

class RetryDrive {
 public:
  RetryDrive(const DriverParams& params, int attempts, double retry_s);

  void go(const Point2& goal_map, RobotTime now);
  /// kFailed only when every attempt has failed.
  [[nodiscard]] DriveStep step(const DriveInput& input);
  /// Something else moved the robot: plans anew with the next step; the attempts count on.
  void interrupted();
  void transform(const Pose2& new_T_old);
  [[nodiscard]] const std::vector<Point2>& path() const { return driver_.path(); }

 private:
  [[nodiscard]] DriveStep failed(const std::string& why, RobotTime now);

  PlannedDriver driver_;
  int attempts_;
  double retry_s_;
  Point2 goal_ = Point2::Zero();
  bool driving_ = false;
  int failures_ = 0;
  RobotTime next_try_;
};

}  // namespace seeker::nav
