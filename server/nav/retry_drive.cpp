#include "server/nav/retry_drive.hpp"

namespace seeker::nav {

RetryDrive::RetryDrive(const DriverParams& params, int attempts, double retry_s)
    : driver_(params), attempts_(attempts), retry_s_(retry_s) {}

void RetryDrive::go(const Point2& goal_map, RobotTime now) {
  goal_ = goal_map;
  failures_ = 0;
  next_try_ = now;
  interrupted();
}

void RetryDrive::interrupted() {
  driver_.stop();
  driving_ = false;
}

void RetryDrive::transform(const Pose2& new_T_old) {
  goal_ = new_T_old * goal_;
  interrupted();
}

DriveStep RetryDrive::step(const DriveInput& input) {
  if (!driving_) {
    if (input.now < next_try_) {
      return {{}, DriveState::kDriving, {}};
    }
    if (!driver_.start(input, goal_)) {
      return failed(driver_.reason(), input.now);
    }
    driving_ = true;
  }
  const DriveStep driven = driver_.step(input);
  if (driven.state == DriveState::kFailed || driven.state == DriveState::kIdle) {
    return failed(driven.reason, input.now);
  }
  return driven;
}

DriveStep RetryDrive::failed(const std::string& why, RobotTime now) {
  interrupted();
  if (++failures_ >= attempts_) {
    return {{}, DriveState::kFailed, why};
  }
  next_try_ = now + seconds(retry_s_);
  return {{}, DriveState::kDriving, {}};
}

}  // namespace seeker::nav
