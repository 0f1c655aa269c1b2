/// \file
/// What moves the base: who may, what the safety supervisor allows of it, and the motors.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/sensing.hpp"
#include "server/app/loop/situation_source.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/safety/motion_authority.hpp"
#include "server/app/safety/safety_supervisor.hpp"
#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::app {

/// The only one that commands the base. Lives on the loop's thread.
class MotionControl {
 public:
  /// The references outlive it.
  MotionControl(const SafetyParams& params, std::shared_ptr<drivers::BaseDriver> base, const Sensing& sensing,
                const SituationSource& situation, WorldLink& world, Diagnostics& diagnostics);

  /// Powers the motors where that is allowed, and commands what the supervisor allows of `wanted`.
  void act(const Twist2& wanted);
  /// Commands the base to stand and voids the velocities that are on their way.
  void stop();
  /// Latches or releases the emergency stop. False when it was so already.
  bool set_estop(bool engaged);
  /// Stands still and powers the motors off, before the components stop.
  void halt();
  /// The base begins with its motors off, and it stays disarmed until somebody moves it on purpose.
  void restarted(const std::string& component);

  /// Whether the base moves as it is commanded: a recording never does.
  [[nodiscard]] Status drivable() const { return base_->drivable(); }
  [[nodiscard]] MotionAuthority& authority() { return authority_; }
  [[nodiscard]] const MotionAuthority& authority() const { return authority_; }
  /// Why less than what was wanted is allowed; empty when all is.
  [[nodiscard]] const std::string& safety_reason() const { return safety_reason_; }

 private:
  [[nodiscard]] SafetyVerdict verdict_on(const Twist2& wanted) const;
  void refused(const Error& error);

  SafetyParams params_;
  std::shared_ptr<drivers::BaseDriver> base_;
  const Sensing& sensing_;
  const SituationSource& situation_;
  WorldLink& world_;
  Diagnostics& diagnostics_;
  MotionAuthority authority_;
  std::string safety_reason_;
  bool motors_on_ = false;
};

}  // namespace seeker::app
