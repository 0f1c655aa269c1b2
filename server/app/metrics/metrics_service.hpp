/// \file
/// The figures of one robot on their page, as long as the robot runs.
#pragma once

#include <memory>
#include <string>

#include "common/api/robot_api.hpp"
#include "server/app/metrics/metrics_page.hpp"

namespace seeker::app {

/// Follows a robot's loop and state. To be started before the robot, and to end after its loop.
class MetricsService {
 public:
  /// Errors of MetricsPage::open().
  [[nodiscard]] static Result<std::unique_ptr<MetricsService>> start(const MetricsSettings& settings,
                                                                     const std::string& robot_id,
                                                                     const std::string& software_version);

  /// Sets the callbacks of the loop and subscribes to the robot's state.
  void follow(LoopHooks& hooks, api::RobotHost& robot);
  [[nodiscard]] RobotMetrics& metrics() { return *metrics_; }
  [[nodiscard]] std::uint16_t port() const { return page_->port(); }

 private:
  MetricsService() = default;

  std::shared_ptr<RobotMetrics> metrics_;
  std::unique_ptr<MetricsPage> page_;
  std::shared_ptr<api::RobotApi> robot_;
  std::unique_ptr<api::Subscription> status_;
};

}  // namespace seeker::app
