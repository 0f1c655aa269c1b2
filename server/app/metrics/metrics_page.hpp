/// \file
/// The page `/metrics` in the text form of Prometheus.
#pragma once

#include <cstdint>
#include <memory>

#include "server/app/metrics/metrics_settings.hpp"
#include "server/app/metrics/robot_metrics.hpp"

namespace seeker::app {

/// Serves the page on threads of its own while it lives.
class MetricsPage {
 public:
  /// Begins to serve. kInvalidArgument: settings that validate() refuses. kIo names the address that cannot be used.
  [[nodiscard]] static Result<std::unique_ptr<MetricsPage>> open(const MetricsSettings& settings,
                                                                 const std::shared_ptr<RobotMetrics>& metrics);
  MetricsPage(const MetricsPage&) = delete;
  MetricsPage& operator=(const MetricsPage&) = delete;
  ~MetricsPage();

  [[nodiscard]] std::uint16_t port() const;

 private:
  struct Body;
  explicit MetricsPage(std::unique_ptr<Body> body);

  std::unique_ptr<Body> body_;
};

}  // namespace seeker::app
