#include "server/explore/retry_drive.hpp"

namespace seeker::explore {

RetryDrive::RetryDrive(const nav::DriverParams& params, int attempts, double retry_s)
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

nav::DriveStep RetryDrive::step(const nav::DriveInput& input) {
  if (!driving_) {
    if (input.now < next_try_) {
      return {{}, nav::DriveState::kDriving, {}};
    }
    if (!driver_.start(input, goal_)) {
      return failed(driver_.reason(), input.now);
    }
    driving_ = true;
  }
  const nav::DriveStep driven = driver_.step(input);
  if (driven.state == nav::DriveState::kFailed || driven.state == nav::DriveState::kIdle) {
    return failed(driven.reason, input.now);
  }
  return driven;
}

nav::DriveStep RetryDrive::failed(const std::string& why, RobotTime now) {
  interrupted();
  if (++failures_ >= attempts_) {
    return {{}, nav::DriveState::kFailed, why};
  }
  next_try_ = now + seconds(retry_s_);
  return {{}, nav::DriveState::kDriving, {}};
}

}  // namespace seeker::explore
