#include "server/app/runtime/update_hub.hpp"

#include <algorithm>

namespace seeker::app {
namespace {

bool is_journaled(api::Topic topic) {
  return topic == api::Topic::kMission || topic == api::Topic::kEvent || topic == api::Topic::kDetection;
}

}  // namespace

class UpdateHub::Handle final : public api::Subscription {
 public:
  Handle(std::shared_ptr<Shared> shared, std::shared_ptr<Entry> entry)
      : shared_(std::move(shared)), entry_(std::move(entry)) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() override {
    {
      const std::lock_guard lock(shared_->mutex);
      std::erase(shared_->entries, entry_);
      for (std::size_t topic = 0; topic < api::kTopicCount; ++topic) {
        shared_->listeners[topic] -= entry_->topics[topic] ? 1 : 0;
      }
    }
    const std::lock_guard running(entry_->mutex);
    entry_->sink = nullptr;
  }

 private:
  std::shared_ptr<Shared> shared_;
  std::shared_ptr<Entry> entry_;
};

std::unique_ptr<api::Subscription> UpdateHub::subscribe(const std::vector<api::TopicRequest>& topics,
                                                        api::UpdateSink sink) {
  auto entry = std::make_shared<Entry>();
  entry->sink = std::move(sink);
  const std::lock_guard lock(shared_->mutex);
  for (const api::TopicRequest& request : topics) {
    const auto topic = static_cast<std::size_t>(request.topic);
    shared_->listeners[topic] += entry->topics[topic] ? 0 : 1;
    entry->topics[topic] = true;
  }
  shared_->entries.push_back(entry);
  return std::make_unique<Handle>(shared_, entry);
}

bool UpdateHub::wanted(api::Topic topic) const {
  return shared_->listeners[static_cast<std::size_t>(topic)].load(std::memory_order_relaxed) > 0;
}

void UpdateHub::publish(api::Topic topic, RobotTime stamp, api::Payload payload) {
  const auto index = static_cast<std::size_t>(topic);
  auto update = std::make_shared<api::Update>();
  update->topic = topic;
  update->sequence = ++sequence_[index];
  update->stamp = stamp;
  update->payload = std::move(payload);
  if (gate_ && is_journaled(topic)) {
    gate_([this, update] { deliver(update); });
  } else {
    deliver(update);
  }
}

void UpdateHub::deliver(const std::shared_ptr<const api::Update>& update) {
  const auto index = static_cast<std::size_t>(update->topic);
  std::vector<std::shared_ptr<Entry>> entries;
  {
    const std::lock_guard lock(shared_->mutex);
    entries = shared_->entries;
  }
  for (const std::shared_ptr<Entry>& entry : entries) {
    const std::lock_guard running(entry->mutex);
    if (entry->topics[index] && entry->sink) {
      entry->sink(update);
    }
  }
}

}  // namespace seeker::app
