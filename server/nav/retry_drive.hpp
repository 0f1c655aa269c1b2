/// \file
/// A drive that does not give up at once: what blocks the way may be people who move on.
#pragma once

#include <optional>
#include <string>

#include "common/core/map_move.hpp"
#include "server/nav/planned_driver.hpp"
#include "server/nav/progress_watch.hpp"

namespace seeker::nav {

struct RetryParams {
  int attempts = 4;       ///< that may fail in a row, without getting nearer to the goal
  double retry_s = 15.0;  ///< standing still before the next one
};

class RetryDrive {
 public:
  RetryDrive(const DriverParams& params, const RetryParams& retry);

  void go(const Point2& goal_map, RobotTime now, std::optional<double> final_heading_rad = {});
  /// kFailed only when every attempt has failed.
  [[nodiscard]] DriveStep step(const DriveInput& input);
  /// Something else moved the robot: plans anew with the next step; the attempts count on.
  void interrupted();
  void transform(const MapMove& move);
  [[nodiscard]] const std::vector<Point2>& path() const { return driver_.path(); }
  /// Why the last attempt failed, while it stands before the next one; else empty.
  [[nodiscard]] const std::string& waiting_for() const { return waiting_for_; }

 private:
  [[nodiscard]] bool begin(const DriveInput& input);
  [[nodiscard]] DriveStep failed(const std::string& why, RobotTime now);

  PlannedDriver driver_;
  RetryParams retry_;
  Point2 goal_ = Point2::Zero();
  std::optional<double> final_heading_rad_;
  bool driving_ = false;
  int failures_ = 0;
  ProgressWatch progress_;  ///< over all attempts
  RobotTime next_try_;
  std::string waiting_for_;
};

}  // namespace seeker::nav
