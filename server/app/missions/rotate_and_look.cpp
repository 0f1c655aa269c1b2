#include "server/app/missions/rotate_and_look.hpp"

#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"

namespace seeker::app {

void RotateAndLook::start(const Pose2& frame_T_base, int headings) {
  SEEKER_ASSERT(headings > 0);
  headings_ = headings;
  index_ = 0;
  first_rad_ = frame_T_base.theta_rad;
  failures_ = 0;
  resumed();
}

void RotateAndLook::resumed() {
  follower_.clear();
  waiting_ = false;
  turning_since_.reset();
  still_since_.reset();
}

void RotateAndLook::next() {
  ++index_;
  failures_ = 0;
  resumed();
}

void RotateAndLook::looked() {
  if (active()) {
    next();
  }
}

bool RotateAndLook::failed() {
  if (!active()) {
    return false;
  }
  waiting_ = false;
  still_since_.reset();
  if (++failures_ < params_.tries) {
    return false;
  }
  next();
  return true;
}

void RotateAndLook::step(const Pose2& frame_T_base, const Situation& situation, Decision& decision) {
  SEEKER_ASSERT(active());
  if (waiting_) {
    return;
  }
  if (!turning_since_) {
    turning_since_ = situation.now;
    follower_.set_heading(frame_T_base, wrap_angle(first_rad_ + 2.0 * kPi * index_ / headings_), situation.now);
  }
  if (!still_since_) {
    const std::vector<Point2> points =
        situation.scan != nullptr ? points_in_base(*situation.scan) : std::vector<Point2>();
    const nav::FollowStep step = follower_.step(frame_T_base, points, situation.now);
    decision.command = step.command;
    const bool late = to_seconds(situation.now - *turning_since_) > params_.rotation_time_s;
    const bool there = step.state == nav::FollowState::kArrived || step.state == nav::FollowState::kIdle;
    if (there && std::abs(situation.velocity.omega_rad_s) < params_.still_rad_s) {
      still_since_ = situation.now;
    } else if (late) {
      decision.events.push_back({"heading-left-out", "the robot could not turn there", api::Severity::kWarning});
      next();
    }
    return;
  }
  if (to_seconds(situation.now - *still_since_) >= params_.settle_s) {
    waiting_ = true;
    decision.wants_look = true;
  }
}

}  // namespace seeker::app
