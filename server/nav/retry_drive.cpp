#include "server/nav/retry_drive.hpp"

#include "common/core/angle.hpp"

namespace seeker::nav {

RetryDrive::RetryDrive(const DriverParams& params, const RetryParams& retry) : driver_(params), retry_(retry) {}

void RetryDrive::go(const Point2& goal_map, RobotTime now, std::optional<double> final_heading_rad) {
  goal_ = goal_map;
  final_heading_rad_ = final_heading_rad;
  failures_ = 0;
  progress_.start(now);
  next_try_ = now;
  waiting_for_.reset();
  interrupted();
}

void RetryDrive::interrupted() {
  driver_.stop();
  driving_ = false;
}

void RetryDrive::transform(const MapMove& move) {
  const Pose2 new_T_old = move.at(goal_);
  goal_ = new_T_old * goal_;
  if (final_heading_rad_) {
    final_heading_rad_ = wrap_angle(*final_heading_rad_ + new_T_old.theta_rad);
  }
  interrupted();
}

bool RetryDrive::begin(const DriveInput& input) {
  if (waiting_for_) {
    // A person who blocked the path may have left, but is remembered for longer than all attempts last.
    input.floors.forget_past_obstacles();
    waiting_for_.reset();
  }
  driving_ = driver_.start(input, goal_, final_heading_rad_);
  return driving_;
}

DriveStep RetryDrive::step(const DriveInput& input) {
  if (!driving_) {
    if (input.now < next_try_) {
      return {{}, DriveState::kDriving, {}};
    }
    if (!begin(input)) {
      return failed(driver_.failure(), input.now);
    }
  }
  const DriveStep driven = driver_.step(input);
  if (driven.state == DriveState::kFailed || driven.state == DriveState::kIdle) {
    return failed({driven.cause, driven.reason}, input.now);
  }
  if (driven.state == DriveState::kDriving && progress_.nearer(driven.remaining_m, kNearer_m, input.now)) {
    failures_ = 0;
  }
  return driven;
}

DriveStep RetryDrive::failed(const DriveFailure& why, RobotTime now) {
  interrupted();
  if (++failures_ >= retry_.attempts) {
    return {{}, DriveState::kFailed, why.text, 0.0, why.cause};
  }
  next_try_ = now + seconds(retry_.retry_s);
  waiting_for_ = why;
  return {{}, DriveState::kDriving, {}};
}

}  // namespace seeker::nav
