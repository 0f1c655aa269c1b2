/// \file
/// Figures of a running robot in the form that Prometheus collects.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <prometheus/collectable.h>

#include "common/api/robot_state.hpp"
#include "server/app/loop/loop_hooks.hpp"
#include "server/net/server.hpp"

namespace seeker::app {

/// Counts what the loop and its workers take, and keeps the newest state. All methods may be called from any thread;
/// a name has the unit at its end (`_seconds`, `_bytes`), counters end in `_total`.
class RobotMetrics final : public prometheus::Collectable {
 public:
  using ServerStats = std::function<std::optional<server_net::ServerStats>()>;

  RobotMetrics(const std::string& robot_id, const std::string& software_version);
  ~RobotMetrics() override;

  /// Follows a loop, which must not tick any more when this ends.
  void follow(LoopHooks& hooks);
  /// The newest state of the robot.
  void note(api::RobotStatus status);
  /// Where the counts of the network come from; nothing while there is no server.
  void set_server(ServerStats server);

  /// Everything, as of now.
  [[nodiscard]] std::vector<prometheus::MetricFamily> Collect() const override;

 private:
  struct Instruments;

  std::unique_ptr<Instruments> instruments_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::optional<api::RobotStatus> status_;
  ServerStats server_;
};

}  // namespace seeker::app
