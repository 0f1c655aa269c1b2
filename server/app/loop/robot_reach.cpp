// What the robot can be asked to do: whether its world is there, and its base goes where it is told (RobotLoop).
#include "server/app/loop/robot_loop.hpp"

namespace seeker::app {
namespace {

constexpr const char* kWorldLost = "world-lost";

/// All but looking into one direction from where it stands.
bool moves_robot(const api::MissionTask& task) {
  const auto* recognise = std::get_if<api::RecogniseMission>(&task);
  const auto* localise = std::get_if<api::LocaliseMission>(&task);
  return recognise != nullptr ? recognise->headings > 1 : localise == nullptr || localise->headings > 1;
}

std::string remedy_for(const Error& lost) {
  return lost.code == Errc::kCancelled
             ? "restart seekerd: it enters the world that is there now"
             : "check that seeker-emulator runs and the network to it; the robot goes on when its world is back";
}

}  // namespace

bool RobotLoop::world_there() {
  const Status there = parts_.devices.clock->reachable();
  if (there) {
    if (faults_.clear(kWorldLost)) {
      log("fault-cleared", kWorldLost);
      components_.go_on();
      last_odometry_ = last_scan_ = last_sonar_ = now();
    }
    return true;
  }
  const Error& lost = there.error();
  components_.hold_up("driver", lost.message);
  if (const std::optional<api::Fault> before = faults_.find(kWorldLost); !before || before->message != lost.message) {
    raise(kWorldLost, parts_.devices.type, lost.message, remedy_for(lost));
    republish_ = true;
  }
  return false;
}

/// Robot time stands still without a world, so that patience is of the wall clock here.
void RobotLoop::watch_world(WallTime wall_now) {
  if (world_there()) {
    world_lost_at_.reset();
    return;
  }
  world_lost_at_ = world_lost_at_.value_or(wall_now);
  if (missions_.running() && wall_now - *world_lost_at_ > params_.mission.fault_grace) {
    const Error lost = parts_.devices.clock->reachable().error();
    missions_.end(api::Outcome::kFault, lost.message, remedy_for(lost), now());
    republish_ = true;
  }
  if (republish_) {
    publish();
  }
}

Status RobotLoop::within_reach() const {
  if (const Status there = parts_.devices.clock->reachable(); !there) {
    return fail(Errc::kNotReady, there.error().message + "; " + remedy_for(there.error()));
  }
  return ended_ ? fail(Errc::kNotReady, "what the robot senses has ended; restart seekerd") : Status();
}

Status RobotLoop::able_to(const api::MissionTask& task) const {
  if (const Status drivable = parts_.devices.base->drivable(); moves_robot(task) && !drivable) {
    return drivable;
  }
  return within_reach();
}

void RobotLoop::base_refused(const Error& error) {
  if (world_there()) {
    raise("base-refused", "base", "base: " + error.message, "'seeker components --restart base'");
  }
}

void RobotLoop::continue_odometry(drivers::OdometrySample& sample) {
  if (odom_T_restart_) {
    odom_T_counted_ = *odom_T_restart_ * inverse(sample.odom_T_base);
    odom_T_restart_.reset();
  }
  if (odom_T_counted_) {
    sample.odom_T_base = *odom_T_counted_ * sample.odom_T_base;
  }
}

}  // namespace seeker::app
