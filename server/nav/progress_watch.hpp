/// \file
/// Detects that a quantity has stopped falling, or that a robot has stopped moving.
#pragma once

#include <limits>

#include "common/core/pose2.hpp"
#include "common/core/time.hpp"

namespace seeker::nav {

/// Watches a remaining distance; progress is every fall by at least `step_m`.
class ProgressWatch {
 public:
  void start(RobotTime now) {
    started_ = now;
    since_ = now;
    best_m_ = std::numeric_limits<double>::infinity();
  }
  /// Records the present remaining distance and returns whether it is progress.
  bool nearer(double remaining_m, double step_m, RobotTime now) {
    if (remaining_m >= best_m_ - step_m) {
      return false;
    }
    best_m_ = remaining_m;
    since_ = now;
    return true;
  }
  /// Records the present remaining distance and returns the seconds without progress.
  double idle_s(double remaining_m, double step_m, RobotTime now) {
    nearer(remaining_m, step_m, now);
    return to_seconds(now - since_);
  }
  /// The time before this call no longer counts as lack of progress; the total time is not reset.
  void go_on(RobotTime now) { since_ = now; }
  [[nodiscard]] double total_s(RobotTime now) const { return to_seconds(now - started_); }

 private:
  RobotTime started_;
  RobotTime since_;
  double best_m_ = std::numeric_limits<double>::infinity();
};

/// Watches a position: the robot is stuck when it stays within `move_m` of one place.
class MotionWatch {
 public:
  void start(const Point2& p_map, RobotTime now) {
    anchor_ = p_map;
    since_ = now;
  }
  /// Seconds within `move_m` of the anchor; a position farther away becomes the new anchor.
  double idle_s(const Point2& p_map, double move_m, RobotTime now) {
    if ((p_map - anchor_).norm() > move_m) {
      start(p_map, now);
    }
    return to_seconds(now - since_);
  }

 private:
  Point2 anchor_ = Point2::Zero();
  RobotTime since_;
};

}  // namespace seeker::nav
