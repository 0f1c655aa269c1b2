/// \file
/// Looks around with the stereo camera: turns on the spot to evenly spaced headings and asks for a look at each.
#pragma once

#include <optional>

#include "server/app/missions/behaviour.hpp"
#include "server/nav/path_follower.hpp"

namespace seeker::app {

struct RotateAndLookParams {
  nav::FollowerParams follower;
  double settle_s = 0.5;          ///< standing still before a look: the body rocks after a turn
  double still_rad_s = 0.02;      ///< slower than this is standing still
  double rotation_time_s = 20.0;  ///< longest rotation to one heading; beyond it that heading is left out
  int tries = 3;                  ///< looks at one heading before it is left out
};

/// Poses may be those of any frame that does not jump, as long as they all are of one.
class RotateAndLook {
 public:
  explicit RotateAndLook(const RotateAndLookParams& params) : params_(params), follower_(params.follower) {}

  /// Begins at the heading that the robot has.
  void start(const Pose2& frame_T_base, int headings);
  /// True until every heading was looked at or left out.
  [[nodiscard]] bool active() const { return index_ < headings_; }
  [[nodiscard]] int index() const { return index_; }
  [[nodiscard]] int headings() const { return headings_; }
  /// Sets the decision's command and wants_look; must be active.
  void step(const Pose2& frame_T_base, const Situation& situation, Decision& decision);
  /// The look at this heading came to something: on to the next.
  void looked();
  /// It did not: again, or on to the next. True where the heading is left out.
  bool failed();
  /// Time passed without steps.
  void resumed();

 private:
  void next();

  RotateAndLookParams params_;
  nav::PathFollower follower_;
  int headings_ = 0;
  int index_ = 0;
  int failures_ = 0;
  double first_rad_ = 0.0;
  bool waiting_ = false;  ///< a look was asked for
  std::optional<RobotTime> turning_since_;
  std::optional<RobotTime> still_since_;
};

}  // namespace seeker::app
