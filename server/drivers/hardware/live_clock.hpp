/// \file
/// Robot time of real devices.
#pragma once

#include <chrono>

#include "server/drivers/interfaces/drivers.hpp"
#include "server/drivers/interfaces/pacer.hpp"

namespace seeker::drivers {

/// The monotonic clock since the robot's start. now() may be called from any thread, so that a driver stamps a reading
/// when it arrives and not when the loop fetches it.
class LiveClock final : public Clock {
 public:
  [[nodiscard]] RobotTime now() const override {
    return RobotTime(std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now() - start_));
  }
  [[nodiscard]] Status advance(Duration period) override {
    pacer_.start(period);
    return {};
  }
  void let_go() override { pacer_.rest(); }
  [[nodiscard]] Result<bool> await(Duration limit) override { return pacer_.await(limit); }
  [[nodiscard]] bool lockstep() const override { return false; }
  [[nodiscard]] double speed() const override { return 1.0; }
  [[nodiscard]] std::optional<TickTiming> timing() const override { return pacer_.timing(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Pacer pacer_{1.0};
};

}  // namespace seeker::drivers
