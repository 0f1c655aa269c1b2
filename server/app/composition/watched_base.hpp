/// \file
/// A base whose odometry is kept for other drivers, which take its motion out of their readings.
#pragma once

#include <memory>
#include <utility>

#include "server/app/estimators/odometry_history.hpp"
#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::app {

/// The base as it is; what is read from it is added to a history.
class WatchedBase final : public drivers::BaseDriver {
 public:
  WatchedBase(std::shared_ptr<drivers::BaseDriver> base, std::shared_ptr<OdometryHistory> history)
      : base_(std::move(base)), history_(std::move(history)) {}

  [[nodiscard]] Status activate() override;
  void deactivate() override { base_->deactivate(); }
  [[nodiscard]] Status set_period(Duration period) override { return base_->set_period(period); }
  [[nodiscard]] std::vector<drivers::DeviceFault> faults() const override { return base_->faults(); }
  [[nodiscard]] std::optional<drivers::LinkStatistics> statistics() const override { return base_->statistics(); }
  [[nodiscard]] Result<std::optional<drivers::OdometrySample>> read() override;
  [[nodiscard]] Status set_velocity(const Twist2& velocity, RobotTime now) override {
    return base_->set_velocity(velocity, now);
  }
  [[nodiscard]] Status set_motors(bool enabled) override { return base_->set_motors(enabled); }
  [[nodiscard]] Status drivable() const override { return base_->drivable(); }

 private:
  std::shared_ptr<drivers::BaseDriver> base_;
  std::shared_ptr<OdometryHistory> history_;
};

}  // namespace seeker::app
