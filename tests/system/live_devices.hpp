/// \file
/// Makes a simulated robot believe that its time runs with the wall clock, and watches what its base is commanded.
#pragma once

#include <memory>
#include <utility>

#include "server/app/runtime/devices.hpp"

namespace seeker::testing {

/// Robot time at speed 1 as far as the robot can tell, and as fast as the test goes.
class LiveClock final : public drivers::Clock {
 public:
  explicit LiveClock(std::shared_ptr<drivers::Clock> clock) : clock_(std::move(clock)) {}
  [[nodiscard]] RobotTime now() const override { return clock_->now(); }
  [[nodiscard]] Status advance(Duration period) override { return clock_->advance(period); }
  [[nodiscard]] bool lockstep() const override { return true; }
  [[nodiscard]] double speed() const override { return 1.0; }

 private:
  std::shared_ptr<drivers::Clock> clock_;
};

/// A base that remembers its last command, and since when it stands by command.
class WatchedBase final : public drivers::BaseDriver {
 public:
  explicit WatchedBase(std::shared_ptr<drivers::BaseDriver> base) : base_(std::move(base)) {}
  [[nodiscard]] Status activate() override { return base_->activate(); }
  void deactivate() override { base_->deactivate(); }
  [[nodiscard]] Result<std::optional<drivers::OdometrySample>> read() override { return base_->read(); }
  [[nodiscard]] Status set_velocity(const Twist2& velocity, RobotTime now) override {
    if (velocity == Twist2{} && !(commanded_ == Twist2{})) {
      zero_since_ = now;
    }
    commanded_ = velocity;
    return base_->set_velocity(velocity, now);
  }
  [[nodiscard]] Status set_motors(bool enabled) override { return base_->set_motors(enabled); }
  [[nodiscard]] Status drivable() const override { return base_->drivable(); }

  [[nodiscard]] const Twist2& commanded() const { return commanded_; }
  /// Since when zero velocity is commanded, where it is.
  [[nodiscard]] RobotTime zero_since() const { return zero_since_; }

 private:
  std::shared_ptr<drivers::BaseDriver> base_;
  Twist2 commanded_;
  RobotTime zero_since_;
};

}  // namespace seeker::testing
