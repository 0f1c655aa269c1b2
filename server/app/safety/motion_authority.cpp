#include "server/app/safety/motion_authority.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::app {
namespace {

/// Of what the command itself says.
Status validate(const api::DriveCommand& command, RobotTime now) {
  if (!std::isfinite(command.velocity.v_m_s) || !std::isfinite(command.velocity.omega_rad_s)) {
    return fail(Errc::kInvalidArgument, "the velocity is not a finite number");
  }
  if (command.ttl <= Duration::zero() || command.ttl > api::kMaxDriveTtl) {
    return fail(Errc::kInvalidArgument, "a velocity command lives above 0 and at most 1 s");
  }
  if (command.sent && *command.sent > now + api::kMaxDriveClockError) {
    return fail(Errc::kRefused, "the command comes from the future; compare the clocks again");
  }
  if (command.sent && now - *command.sent >= command.ttl) {
    return fail(Errc::kTimeout, "the command arrived " + std::to_string(to_seconds(now - *command.sent)) +
                                    " s after it was sent, when its life was over; check the link, or give it more");
  }
  return {};
}

}  // namespace

Result<api::LeaseState> MotionAuthority::command_lease(const api::Caller& caller, const api::LeaseCommand& command,
                                                       Lease::WallTime now) {
  const std::string owner = lease().owner;
  Result<api::LeaseState> state = lease_.command(caller, command, now);
  if (lease().owner != owner) {
    drive_.reset();
  }
  return state;
}

void MotionAuthority::forget(const std::string& client) {
  if (lease().owner == client) {
    drive_.reset();
  }
  lease_.forget(client);
}

void MotionAuthority::silent(const std::string& client) {
  if (lease().owner == client) {
    drive_.reset();
  }
  lease_.silent(client);
}

void MotionAuthority::stop() {
  drive_.reset();
  lease_.void_commands();
}

Status MotionAuthority::drive(const std::string& client, const api::DriveCommand& command, RobotTime now) {
  if (estop_) {
    return fail(Errc::kRefused, "the emergency stop is latched; release it with 'seeker estop --release'");
  }
  // What is wrong with a command may be known to its sender alone: who may send one comes first.
  if (const Status taken = lease_.take(client, command.lease_epoch, command.sequence); !taken) {
    return taken;
  }
  if (const Status valid = validate(command, now); !valid) {
    return valid;
  }
  drive_ = Drive{command.velocity, std::min(command.sent.value_or(now), now) + command.ttl};
  return {};
}

std::optional<Twist2> MotionAuthority::drive_velocity(RobotTime now) const {
  if (!drive_ || now >= drive_->expires) {
    return std::nullopt;
  }
  return drive_->velocity;
}

void MotionAuthority::set_estop(bool engaged) {
  estop_ = engaged;
  armed_ = false;
  drive_.reset();
}

}  // namespace seeker::app
