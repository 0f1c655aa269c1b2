#include "server/app/metrics/metrics_service.hpp"

#include <utility>
#include <variant>

namespace seeker::app {

Result<std::unique_ptr<MetricsService>> MetricsService::start(const MetricsSettings& settings,
                                                              const std::string& robot_id,
                                                              const std::string& software_version) {
  std::unique_ptr<MetricsService> service(new MetricsService);
  service->metrics_ = std::make_shared<RobotMetrics>(robot_id, software_version);
  Result<std::unique_ptr<MetricsPage>> page = MetricsPage::open(settings, service->metrics_);
  if (!page) {
    return tl::unexpected<Error>(page.error());
  }
  service->page_ = std::move(*page);
  return service;
}

void MetricsService::follow(LoopHooks& hooks, api::RobotHost& robot) {
  metrics_->follow(hooks);
  robot_ = robot.open({"", api::Role::kObserver});
  auto subscribed = robot_->subscribe({{.topic = api::Topic::kStatus}}, [this](const api::UpdatePtr& update) {
    if (const auto* status = std::get_if<api::RobotStatus>(&update->payload)) {
      metrics_->note(*status);
    }
  });
  status_ = subscribed ? std::move(*subscribed) : nullptr;
}

}  // namespace seeker::app
