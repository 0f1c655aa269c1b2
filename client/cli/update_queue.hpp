/// \file
/// Updates of a subscription, handed from the thread that delivers them to the verb that waits for them.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>

#include "client/cli/context.hpp"
#include "common/api/robot_api.hpp"

namespace seeker::cli {

/// A bounded queue: when a verb reads too slowly, the oldest updates are dropped and counted.
class UpdateQueue {
 public:
  static constexpr std::size_t kLimit = 65536;

  void push(const api::UpdatePtr& update) {
    {
      const std::lock_guard lock(mutex_);
      if (updates_.size() >= kLimit) {
        updates_.pop_front();
        ++lost_;
      }
      updates_.push_back(update);
    }
    changed_.notify_one();
  }

  /// Waits for an update and returns the oldest; std::nullopt when none came in time.
  [[nodiscard]] std::optional<api::UpdatePtr> pop(Duration wait) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, wait, [this] { return !updates_.empty(); })) {
      return std::nullopt;
    }
    api::UpdatePtr update = updates_.front();
    updates_.pop_front();
    return update;
  }

  [[nodiscard]] std::size_t lost() const {
    const std::lock_guard lock(mutex_);
    return lost_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<api::UpdatePtr> updates_;
  std::size_t lost_ = 0;
};

/// A subscription with its queue; ends when destroyed.
struct Stream {
  std::shared_ptr<UpdateQueue> queue = std::make_shared<UpdateQueue>();
  std::unique_ptr<api::Subscription> subscription;
};

[[nodiscard]] inline Result<Stream> open_stream(api::RobotApi& robot, const std::vector<api::TopicRequest>& topics) {
  Stream stream;
  auto subscription = robot.subscribe(topics, [queue = stream.queue](const api::UpdatePtr& u) { queue->push(u); });
  if (!subscription) {
    return tl::unexpected<Error>(subscription.error());
  }
  stream.subscription = std::move(*subscription);
  return stream;
}

/// The first value of a topic that comes within the answer time. Errors: kTimeout with `nothing_came`, and what broke
/// the connection meanwhile.
template <class T>
[[nodiscard]] Result<T> first_of(const Context& context, api::Topic topic, const std::string& nothing_came) {
  const Result<Stream> stream = open_stream(*context.robot, {{topic, 0.0, 0}});
  if (!stream) {
    return tl::unexpected<Error>(stream.error());
  }
  const auto end = std::chrono::steady_clock::now() + context.answer_time();
  while (std::chrono::steady_clock::now() < end) {
    if (const auto update = stream->queue->pop(kPollPeriod)) {
      if (const T* value = std::get_if<T>(&(*update)->payload)) {
        return *value;
      }
    }
    if (const std::optional<Error> error = broken(context)) {
      return tl::unexpected<Error>(*error);
    }
  }
  return fail(Errc::kTimeout, nothing_came);
}

}  // namespace seeker::cli
