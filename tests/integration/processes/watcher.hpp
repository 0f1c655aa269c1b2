/// \file
/// What a client sees of a robot's missions.
#pragma once

#include <condition_variable>
#include <future>
#include <memory>
#include <mutex>
#include <optional>

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
          {
            const std::scoped_lock lock(mutex_);
            last_ = status;
          }
          changed_.notify_all();
          if (status.end) {
            std::call_once(once_, [&] { ended_.set_value(status); });
          }
        });
    EXPECT_TRUE(subscription);
    subscription_ = std::move(*subscription);
  }

  [[nodiscard]] api::RobotStatus status() const {
    const Result<api::RobotStatus> status =
        rpc::wait<api::RobotStatus>([&](auto reply) { client_->get_status(std::move(reply)); }, kCall);
    EXPECT_TRUE(status) << status.error().message;
    return status.value();
  }
  /// Until the mission is as wanted. Told, not asked for: a client that asks as fast as it can is refused.
  template <class Wanted>
  api::RobotStatus until(Wanted wanted, seconds limit = seconds(60)) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, limit, [&] { return last_ && wanted(*last_); }))
        << "the mission did not come to be as wanted";
    lock.unlock();
    return status();
  }
  [[nodiscard]] api::MissionStatus end(seconds limit = seconds(60)) {
    EXPECT_TRUE(ends_within(limit)) << "the mission did not end";
    return end_.get();
  }
  [[nodiscard]] bool ends_within(seconds limit) const { return end_.wait_for(limit) == std::future_status::ready; }

 private:
  std::shared_ptr<rpc::RobotClient> client_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<api::MissionStatus> last_;
  std::once_flag once_;
  std::promise<api::MissionStatus> ended_;
  std::shared_future<api::MissionStatus> end_ = ended_.get_future().share();
  std::unique_ptr<api::Subscription> subscription_;
};

inline bool under_way(const api::MissionStatus& mission) { return mission.path_length_m > 0.5; }

}  // namespace seeker::testing
