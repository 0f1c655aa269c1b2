/// \file
/// A drive with several attempts: people who block the path may move on.
#pragma once

#include <optional>
#include <string>

#include "common/core/map_move.hpp"
#include "server/nav/planned_driver.hpp"
#include "server/nav/progress_watch.hpp"

namespace seeker::nav {

struct RetryParams {
  int attempts = 4;       ///< attempts that may fail in a row, without progress towards the goal
  double retry_s = 15.0;  ///< pause at rest before the next attempt
};

class RetryDrive {
 public:
  RetryDrive(const DriverParams& params, const RetryParams& retry);

  void go(const Point2& goal_map, RobotTime now, std::optional<double> final_heading_rad = {});
  /// Computes one control step. The state is kFailed only when every attempt has failed.
  [[nodiscard]] DriveStep step(const DriveInput& input);
  /// Another behaviour has moved the robot: the next step plans again, and the attempts keep their count.
  void interrupted();
  void transform(const MapMove& move);
  [[nodiscard]] const std::vector<Point2>& path() const { return driver_.path(); }
  /// Why the last attempt failed, while the robot waits for the next one; else nothing.
  [[nodiscard]] const std::optional<DriveFailure>& waiting_for() const { return waiting_for_; }

 private:
  [[nodiscard]] bool begin(const DriveInput& input);
  [[nodiscard]] DriveStep failed(const DriveFailure& why, RobotTime now);

  PlannedDriver driver_;
  RetryParams retry_;
  Point2 goal_ = Point2::Zero();
  std::optional<double> final_heading_rad_;
  bool driving_ = false;
  int failures_ = 0;
  ProgressWatch progress_;  ///< progress over all attempts
  RobotTime next_try_;
  std::optional<DriveFailure> waiting_for_;
};

}  // namespace seeker::nav
