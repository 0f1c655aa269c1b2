/// \file
/// Hands what the loop publishes to whoever subscribed in this process.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "common/api/robot_api.hpp"

namespace seeker::app {

/// Numbers updates per topic and calls the sinks on the publishing thread, or by the gate on the one that opens it.
class UpdateHub {
 public:
  /// Ends when the returned object is destroyed; the hub may be gone by then. `on_subscribed` of the hub runs once
  /// per call, so that whoever fills the hub can send what a newcomer needs.
  [[nodiscard]] std::unique_ptr<api::Subscription> subscribe(const std::vector<api::TopicRequest>& topics,
                                                             api::UpdateSink sink);
  /// True when somebody listens: the loop does not build what nobody wants.
  [[nodiscard]] bool wanted(api::Topic topic) const;
  void publish(api::Topic topic, RobotTime stamp, api::Payload payload);
  /// From now on updates of missions, events and detections wait for `gate`, which keeps their order and calls each
  /// one's `deliver` once, on any one thread: what is published shall be on the disk before. The hub outlives those
  /// calls.
  void set_gate(std::function<void(std::function<void()> deliver)> gate) { gate_ = std::move(gate); }

 private:
  struct Entry {
    std::mutex mutex;  ///< held while the sink runs, so that unsubscribing waits for it
    std::array<bool, api::kTopicCount> topics{};
    api::UpdateSink sink;
  };
  struct Shared {
    std::mutex mutex;
    std::vector<std::shared_ptr<Entry>> entries;
    std::array<std::atomic<int>, api::kTopicCount> listeners{};
  };
  class Handle;

  void deliver(const std::shared_ptr<const api::Update>& update);

  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
  std::array<std::uint64_t, api::kTopicCount> sequence_{};
  std::function<void(std::function<void()>)> gate_;
};

}  // namespace seeker::app
