/// \file
/// What a client sees of a robot's missions.
#pragma once

#include <future>
#include <memory>
#include <mutex>

#include "common/rpc/wait.hpp"
#include "tests/integration/processes/daemon.hpp"

namespace seeker::testing {

/// Follows a robot's missions.
class Watcher {
 public:
  explicit Watcher(const Daemon& daemon) : client_(connect(daemon, "watcher")) {
    Result<std::unique_ptr<api::Subscription>> subscription =
        client_->subscribe({{.topic = api::Topic::kMission}}, [this](const api::UpdatePtr& update) {
          const auto& status = std::get<api::MissionStatus>(update->payload);
          if (status.end) {
            std::call_once(once_, [&] { ended_.set_value(status); });
          }
        });
    EXPECT_TRUE(subscription);
    subscription_ = std::move(*subscription);
  }

  [[nodiscard]] api::RobotStatus status() const {
    return rpc::wait<api::RobotStatus>([&](auto reply) { client_->get_status(std::move(reply)); }, kCall).value();
  }
  /// Asks until the mission is as wanted.
  template <class Wanted>
  api::RobotStatus until(Wanted wanted) const {
    for (;;) {
      api::RobotStatus now = status();
      if (now.mission && wanted(*now.mission)) {
        return now;
      }
    }
  }
  [[nodiscard]] api::MissionStatus end(seconds limit = seconds(60)) {
    EXPECT_TRUE(ends_within(limit)) << "the mission did not end";
    return end_.get();
  }
  [[nodiscard]] bool ends_within(seconds limit) const { return end_.wait_for(limit) == std::future_status::ready; }

 private:
  std::shared_ptr<rpc::RobotClient> client_;
  std::once_flag once_;
  std::promise<api::MissionStatus> ended_;
  std::shared_future<api::MissionStatus> end_ = ended_.get_future().share();
  std::unique_ptr<api::Subscription> subscription_;
};

inline bool under_way(const api::MissionStatus& mission) { return mission.path_length_m > 0.5; }

}  // namespace seeker::testing
