#include "server/app/safety/motion_authority.hpp"

#include <cmath>

namespace seeker::app {
namespace {

std::string held_by(const std::string& owner) {
  return "'" + owner + "' holds the lease; wait until it is released, or take it over with 'seeker drive --take-over'";
}

}  // namespace

void MotionAuthority::hand_over(const std::string& client) {
  lease_.owner = client;
  lease_.requested_by.clear();
  ++lease_.epoch;
  stopped_.reset();
  drive_.reset();
}

void MotionAuthority::stop() {
  drive_.reset();
  if (!lease_.owner.empty()) {
    stopped_ = lease_.epoch++;
  }
}

Result<api::LeaseState> MotionAuthority::command_lease(const std::string& client, api::LeaseAction action) {
  const bool owner = lease_.owner == client;
  switch (action) {
    case api::LeaseAction::kAcquire:
      if (!lease_.owner.empty() && !owner) {
        return fail(Errc::kRefused, held_by(lease_.owner));
      }
      if (!owner) {
        hand_over(client);
      }
      return lease_;
    case api::LeaseAction::kTakeOver:
      if (!owner) {
        hand_over(client);
      }
      return lease_;
    case api::LeaseAction::kRequest:
      if (!owner) {
        lease_.requested_by = client;
      }
      return lease_;
    case api::LeaseAction::kGrant:
    case api::LeaseAction::kDeny:
      if (!owner || lease_.requested_by.empty()) {
        return fail(Errc::kRefused, owner ? "nobody asks for the lease" : "only the owner of the lease may answer");
      }
      if (action == api::LeaseAction::kGrant) {
        hand_over(lease_.requested_by);
      } else {
        lease_.requested_by.clear();
      }
      return lease_;
    case api::LeaseAction::kRelease:
      if (owner) {
        hand_over(lease_.requested_by);
      }
      return lease_;
  }
  return fail(Errc::kInvalidArgument, "unknown lease action");
}

void MotionAuthority::forget(const std::string& client) {
  if (lease_.requested_by == client) {
    lease_.requested_by.clear();
  }
  if (lease_.owner == client) {
    hand_over(lease_.requested_by);
  }
}

Status MotionAuthority::drive(const std::string& client, const api::DriveCommand& command, RobotTime now) {
  if (estop_) {
    return fail(Errc::kRefused, "the emergency stop is latched; release it with 'seeker estop --release'");
  }
  if (lease_.owner != client) {
    return fail(Errc::kRefused,
                lease_.owner.empty() ? "driving needs the lease; acquire it first" : held_by(lease_.owner));
  }
  if (stopped_ && command.lease_epoch == *stopped_) {
    return fail(Errc::kRefused, "the robot was stopped while it was driven by hand; acquire the lease again to go on");
  }
  if (command.lease_epoch != lease_.epoch) {
    return fail(Errc::kRefused, "the command belongs to an earlier lease; acquire the lease again");
  }
  if (!std::isfinite(command.velocity.v_m_s) || !std::isfinite(command.velocity.omega_rad_s)) {
    return fail(Errc::kInvalidArgument, "the velocity is not a finite number");
  }
  if (command.ttl <= Duration::zero() || command.ttl > api::kMaxDriveTtl) {
    return fail(Errc::kInvalidArgument, "a velocity command lives above 0 and at most 1 s");
  }
  drive_ = Drive{command.velocity, now + command.ttl};
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
