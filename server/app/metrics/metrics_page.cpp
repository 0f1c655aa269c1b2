#include "server/app/metrics/metrics_page.hpp"

#include <exception>
#include <utility>

#include <prometheus/exposer.h>

namespace seeker::app {
namespace {

/// Readers at the same time; each reads one page now and then.
constexpr std::size_t kThreads = 2;

}  // namespace

struct MetricsPage::Body {
  Body(const std::string& address, std::shared_ptr<RobotMetrics> shown)
      : metrics(std::move(shown)), exposer(address, kThreads) {
    exposer.RegisterCollectable(metrics);
  }

  std::shared_ptr<RobotMetrics> metrics;  ///< which the exposer does not keep alive
  prometheus::Exposer exposer;
};

Result<std::unique_ptr<MetricsPage>> MetricsPage::open(const MetricsSettings& settings,
                                                       const std::shared_ptr<RobotMetrics>& metrics) {
  if (const Status ok = validate(settings); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  const std::string address = settings.address + ":" + std::to_string(settings.port);
  try {
    return std::unique_ptr<MetricsPage>(new MetricsPage(std::make_unique<Body>(address, metrics)));
  } catch (const std::exception& error) {
    return fail(Errc::kIo, "metrics cannot be served at " + address + ": " + error.what() +
                               "; choose another metrics.port, or end the program that uses it");
  }
}

MetricsPage::MetricsPage(std::unique_ptr<Body> body) : body_(std::move(body)) {}
MetricsPage::~MetricsPage() = default;

std::uint16_t MetricsPage::port() const {
  const std::vector<int> ports = body_->exposer.GetListeningPorts();
  return ports.empty() ? 0 : static_cast<std::uint16_t>(ports.front());
}

}  // namespace seeker::app
