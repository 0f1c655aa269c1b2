/// \file
/// Who may move the robot and for how long: lease, perishable velocity commands, emergency stop. No clock and no
/// thread: the present time is an argument.
#pragma once

#include <optional>
#include <string>

#include "common/api/robot_api.hpp"
#include "common/core/result.hpp"
#include "server/app/safety/lease.hpp"

namespace seeker::app {

class MotionAuthority {
 public:
  explicit MotionAuthority(const LeaseParams& lease = {}) : lease_(lease) {}

  /// Lease actions of `caller`; see Lease::command(). A new owner begins with no velocity in force.
  [[nodiscard]] Result<api::LeaseState> command_lease(const api::Caller& caller, const api::LeaseCommand& command,
                                                      Lease::WallTime now);
  /// The client left on purpose: its lease is given up, its last command is void.
  void forget(const std::string& client);
  /// The client is silent: its lease is stale, its last command is void.
  void silent(const std::string& client);
  /// See Lease::watch().
  bool watch(Lease::WallTime now) { return lease_.watch(now); }
  [[nodiscard]] const api::LeaseState& lease() const { return lease_.state(); }
  /// Uses other times of patience from the next request on.
  void use(const LeaseParams& params) { lease_.use(params); }
  /// See Lease::free_for().
  [[nodiscard]] Status free_for(const std::string& client) const { return lease_.free_for(client); }

  /// Takes a velocity for at most its time to live, which counts from when it was sent. Refused without the lease, with
  /// a stale lease epoch, while the emergency stop is latched, or with a life above api::kMaxDriveTtl. kTimeout: its
  /// life was over when it arrived.
  [[nodiscard]] Status drive(const std::string& client, const api::DriveCommand& command, RobotTime now);
  /// The velocity in force; nothing when none was given or the last one has expired.
  [[nodiscard]] std::optional<Twist2> drive_velocity(RobotTime now) const;
  void cancel_drive() { drive_.reset(); }
  /// Somebody stopped the robot. The owner keeps the lease under a new epoch: the commands that were sent before
  /// are refused, and it moves again only after acquiring it again.
  void stop();

  /// Latches. Releasing leaves the robot disarmed.
  void set_estop(bool engaged);
  [[nodiscard]] bool estop() const { return estop_; }
  /// An operator asked for motion on purpose (mission, resume, lease): the motors may be powered.
  void arm() { armed_ = !estop_; }
  void disarm() { armed_ = false; }
  [[nodiscard]] bool armed() const { return armed_ && !estop_; }

 private:
  struct Drive {
    Twist2 velocity;
    RobotTime expires;
  };

  Lease lease_;
  std::optional<Drive> drive_;
  bool estop_ = false;
  bool armed_ = false;
};

}  // namespace seeker::app
