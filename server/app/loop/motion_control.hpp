/// \file
/// MotionControl moves the base: it knows who may command it, what the safety supervisor allows, and the motors.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/wheel_calibration.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/sensing.hpp"
#include "server/app/loop/situation_source.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/safety/motion_authority.hpp"
#include "server/app/safety/recent_obstacles.hpp"
#include "server/app/safety/safety_supervisor.hpp"
#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::app {

/// No other class commands the base. Lives on the loop's thread.
class MotionControl {
 public:
  /// The references must outlive it. The base is commanded by its own measure of its wheels, which `calibration`
  /// corrects in its odometry.
  MotionControl(const SafetyParams& params, const WheelCalibration& calibration,
                std::shared_ptr<drivers::BaseDriver> base, const Sensing& sensing, const SituationSource& situation,
                WorldLink& world, Diagnostics& diagnostics);

  /// Takes in what Sensing has read; call it after each read.
  void look_around();
  /// Powers the motors where that is allowed, and commands what the supervisor allows of `wanted`.
  void act(const Twist2& wanted);
  /// Commands the base to stand and voids the velocity commands that have been sent and not yet carried out.
  void stop();
  /// Latches or releases the emergency stop; the log names the client. Returns false when it was in that state already.
  bool set_estop(bool engaged, const std::string& client = "");
  /// Stands still and powers the motors off, before the components stop.
  void halt();
  /// Call it after a component was restarted: the robot stays disarmed until somebody moves it on purpose, and a
  /// restarted base has its motors off.
  void restarted(const std::string& component);

  /// Uses other limits from now on.
  void use(const SafetyParams& params) {
    params_ = params;
    authority_.use(params.lease);
  }

  /// Success when the base obeys commands; the error says why it does not. A recording never does.
  [[nodiscard]] Status drivable() const { return base_->drivable(); }
  [[nodiscard]] MotionAuthority& authority() { return authority_; }
  [[nodiscard]] const MotionAuthority& authority() const { return authority_; }
  /// Returns why less than what was wanted is allowed; empty when all is.
  [[nodiscard]] const std::string& safety_reason() const { return safety_reason_; }

 private:
  [[nodiscard]] SafetyVerdict verdict_on(const Twist2& wanted) const;
  [[nodiscard]] Twist2 commanded(const Twist2& velocity) const;
  void refused(const Error& error);

  SafetyParams params_;
  WheelCalibration calibration_;
  std::shared_ptr<drivers::BaseDriver> base_;
  const Sensing& sensing_;
  const SituationSource& situation_;
  WorldLink& world_;
  Diagnostics& diagnostics_;
  MotionAuthority authority_;
  RecentObstacles recent_;
  std::string safety_reason_;
  bool motors_on_ = false;
};

}  // namespace seeker::app
