/// \file
/// Who may move the robot and for how long: lease, perishable velocity commands, emergency stop. No clock and no
/// thread: the present time is an argument.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/api/robot_api.hpp"
#include "common/core/result.hpp"

namespace seeker::app {

class MotionAuthority {
 public:
  /// Lease actions of `client`. kRefused names the owner and the remedy.
  [[nodiscard]] Result<api::LeaseState> command_lease(const std::string& client, api::LeaseAction action);
  /// The owner went away: the lease is free, its last command is void.
  void forget(const std::string& client);
  [[nodiscard]] const api::LeaseState& lease() const { return lease_; }

  /// Takes a velocity for at most its time to live. Refused without the lease, with a stale lease epoch, while the
  /// emergency stop is latched, or with a life above api::kMaxDriveTtl.
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

  void hand_over(const std::string& client);

  api::LeaseState lease_;
  std::optional<std::uint64_t> stopped_;  ///< epoch of the owner's commands that stop() has voided
  std::optional<Drive> drive_;
  bool estop_ = false;
  bool armed_ = false;
};

}  // namespace seeker::app
