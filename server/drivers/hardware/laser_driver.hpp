/// \file
/// A laser scanner on a line of its own.
#pragma once

#include <memory>
#include <utility>

#include "server/drivers/hardware/device_faults.hpp"
#include "server/drivers/interfaces/drivers.hpp"
#include "server/drivers/link/device_thread.hpp"

namespace seeker::drivers {

/// `Session` is an LmsSession or a RplidarSession: take_scan() gives scans, warning() what is wrong with a scanner that
/// measures all the same.
template <class Session>
class LaserDriver final : public LidarDriver {
 public:
  template <class Params>
  LaserDriver(const Params& params, DeviceThreadParams line, std::shared_ptr<const Clock> clock)
      : session_(std::make_shared<Session>(params)),
        thread_("lidar", std::move(line), session_, [clock = std::move(clock)] { return clock->now(); }) {}
  ~LaserDriver() override { deactivate(); }

  [[nodiscard]] Status activate() override {
    thread_.start();
    return {};
  }
  void deactivate() override { thread_.stop(); }
  [[nodiscard]] Result<std::optional<LaserScan>> read() override {
    return thread_.look([&] { return session_->take_scan(); });
  }
  [[nodiscard]] std::vector<DeviceFault> faults() const override {
    return faults_of(thread_.state(), thread_.look([&] { return session_->warning(); }));
  }
  [[nodiscard]] std::optional<LinkStatistics> statistics() const override { return thread_.statistics(); }

 private:
  std::shared_ptr<Session> session_;
  DeviceThread thread_;
};

}  // namespace seeker::drivers
