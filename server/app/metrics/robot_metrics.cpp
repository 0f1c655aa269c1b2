#include "server/app/metrics/robot_metrics.hpp"

#include <utility>

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include "common/core/time.hpp"
#include "server/app/metrics/metric_families.hpp"

namespace seeker::app {
namespace {

using Seconds = std::chrono::duration<double>;

/// From a tick without work to one that is late for everybody.
const prometheus::Histogram::BucketBoundaries kTickBounds_s{0.0005, 0.001, 0.002, 0.005, 0.01, 0.02,
                                                            0.05,   0.1,   0.15,  0.2,   0.5,  1.0};
/// Fine about the usual period: what disturbs the loop by a percent is to be seen.
const prometheus::Histogram::BucketBoundaries kPeriodBounds_s{0.001,  0.01, 0.05,   0.09,  0.095, 0.098, 0.099,
                                                              0.0995, 0.1,  0.1005, 0.101, 0.102, 0.105, 0.11,
                                                              0.12,   0.15, 0.2,    0.5,   1.0};
const prometheus::Histogram::BucketBoundaries kWorkBounds_s{0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0};

prometheus::Family<prometheus::Histogram>& histograms(prometheus::Registry& registry, const char* name,
                                                      const char* help) {
  return prometheus::BuildHistogram().Name(name).Help(help).Register(registry);
}

}  // namespace

struct RobotMetrics::Instruments {
  Instruments(const std::string& robot_id, const std::string& software_version)
      : period(
            histograms(registry, "seeker_loop_period_seconds", "Wall time from tick to tick").Add({}, kPeriodBounds_s)),
        parts(
            histograms(registry, "seeker_loop_part_seconds", "Wall time of the parts of a tick; estimate holds SLAM")),
        sense(parts.Add({{"part", "sense"}}, kTickBounds_s)),
        estimate(parts.Add({{"part", "estimate"}}, kTickBounds_s)),
        decide(parts.Add({{"part", "decide"}}, kTickBounds_s)),
        publish(parts.Add({{"part", "publish"}}, kTickBounds_s)),
        work(histograms(registry, "seeker_vision_seconds", "Wall time of the work on one picture")) {
    prometheus::BuildGauge()
        .Name("seeker_info")
        .Help("Always 1; its labels say which robot and which version this is")
        .Register(registry)
        .Add({{"robot", robot_id}, {"version", software_version}})
        .Set(1.0);
  }

  void count(const TickTimes& tick) {
    if (last_begun) {
      period.Observe(Seconds(tick.begun - *last_begun).count());
    }
    last_begun = tick.begun;
    sense.Observe(to_seconds(tick.sense));
    estimate.Observe(to_seconds(tick.estimate));
    decide.Observe(to_seconds(tick.decide));
    publish.Observe(to_seconds(tick.publish));
  }

  prometheus::Registry registry;
  prometheus::Histogram& period;
  prometheus::Family<prometheus::Histogram>& parts;
  prometheus::Histogram& sense;
  prometheus::Histogram& estimate;
  prometheus::Histogram& decide;
  prometheus::Histogram& publish;
  prometheus::Family<prometheus::Histogram>& work;
  std::optional<std::chrono::steady_clock::time_point> last_begun;  ///< for the loop's thread only
};

RobotMetrics::RobotMetrics(const std::string& robot_id, const std::string& software_version)
    : instruments_(std::make_unique<Instruments>(robot_id, software_version)) {}

RobotMetrics::~RobotMetrics() = default;

void RobotMetrics::follow(LoopHooks& hooks) {
  hooks.on_tick = [this](const TickTimes& tick) { instruments_->count(tick); };
  hooks.on_idle = [this] { instruments_->last_begun.reset(); };
  hooks.on_work = [this](std::string_view work, Duration took) {
    instruments_->work.Add({{"work", std::string(work)}}, kWorkBounds_s).Observe(to_seconds(took));
  };
}

void RobotMetrics::note(api::RobotStatus status) {
  const std::lock_guard lock(mutex_);
  status_ = std::move(status);
}

void RobotMetrics::set_server(ServerStats server) {
  const std::lock_guard lock(mutex_);
  server_ = std::move(server);
}

std::vector<prometheus::MetricFamily> RobotMetrics::Collect() const {
  std::vector<prometheus::MetricFamily> families = instruments_->registry.Collect();
  const std::lock_guard lock(mutex_);
  if (status_) {
    add_status(*status_, families);
  }
  if (const auto stats = server_ ? server_() : std::nullopt) {
    add_network(*stats, families);
  }
  return families;
}

}  // namespace seeker::app
