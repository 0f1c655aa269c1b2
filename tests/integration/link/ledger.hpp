/// \file
/// What two clients were told of the RELIABLE topics, compared item by item.
#pragma once

#include <algorithm>
#include <array>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "common/api/robot_api.hpp"
#include "tests/support/net/await.hpp"

namespace seeker::testing {

/// Each side must see every item once, in order, and the same as the other side. May be told from several threads.
class Ledger {
 public:
  enum Side : std::size_t { kReference, kImpaired };

  /// Both sides follow now: what was told before is not compared, for one may have begun earlier.
  void begin() {
    const std::lock_guard lock(mutex_);
    for (auto& [name, topic] : topics_) {
      topic.before = std::max(topic.last[kReference], topic.last[kImpaired]);
      topic.ahead.clear();
    }
  }
  void note(Side side, const api::UpdatePtr& update) {
    if (api::stream_class(update->topic) != api::StreamClass::kReliable) {
      return;
    }
    const std::lock_guard lock(mutex_);
    Topic& topic = topics_[update->topic];
    check_number(topic, side, *update);
    compare(topic, side, update);
    if (side == kReference) {
      ++items_;
      note_mission(*update);
    }
    changed_.notify_all();
  }

  /// Waits until the reference has seen so many more items. False: not within kPatience.
  [[nodiscard]] bool wait_items(std::size_t more) {
    std::unique_lock lock(mutex_);
    const std::size_t wanted = items_ + more;
    return changed_.wait_for(lock, kPatience, [&] { return items_ >= wanted || running_.empty(); });
  }
  /// Waits until the other one has seen as much.
  [[nodiscard]] bool wait_level() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return level(); });
  }
  [[nodiscard]] bool wait_begun(const api::MissionId& id) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return begun_.count(id) > 0; });
  }
  [[nodiscard]] bool wait_ended(const api::MissionId& id) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return ended_.count(id) > 0 && outcomes_.count(id) > 0; });
  }
  /// The mission that the robot has begun and not ended.
  [[nodiscard]] bool running() const {
    const std::lock_guard lock(mutex_);
    return !running_.empty();
  }

  /// Sentences about what went wrong.
  [[nodiscard]] std::vector<std::string> problems() const {
    const std::lock_guard lock(mutex_);
    return problems_;
  }
  [[nodiscard]] std::size_t items() const {
    const std::lock_guard lock(mutex_);
    return items_;
  }
  /// How often each mission was said to begin and to end.
  [[nodiscard]] std::map<api::MissionId, int> begun() const {
    const std::lock_guard lock(mutex_);
    return begun_;
  }
  [[nodiscard]] std::map<api::MissionId, int> ended() const {
    const std::lock_guard lock(mutex_);
    return ended_;
  }
  /// Of a mission that has ended; empty: its report has not come yet.
  [[nodiscard]] std::string outcome(const api::MissionId& id) const {
    const std::lock_guard lock(mutex_);
    const auto found = outcomes_.find(id);
    return found == outcomes_.end() ? std::string() : found->second;
  }

 private:
  struct Topic {
    std::array<std::uint64_t, 2> last{};
    std::uint64_t before = 0;                       ///< the last number that is not compared
    std::map<std::uint64_t, api::UpdatePtr> ahead;  ///< seen by one side only
    Side who_is_ahead = kReference;
  };

  void check_number(Topic& topic, Side side, const api::Update& update) {
    std::uint64_t& last = topic.last.at(side);
    if (last != 0 && update.sequence != last + 1) {
      problem(update, side, "after number " + std::to_string(last));
    }
    if (update.dropped != 0) {
      problem(update, side, "and misses " + std::to_string(update.dropped));
    }
    last = update.sequence;
  }
  void compare(Topic& topic, Side side, const api::UpdatePtr& update) {
    if (update->sequence <= topic.before) {
      return;
    }
    const auto other = topic.ahead.find(update->sequence);
    if (other == topic.ahead.end()) {
      if (!topic.ahead.empty() && topic.who_is_ahead != side) {
        problem(*update, side, "which the other side has not");
      }
      topic.who_is_ahead = side;
      topic.ahead.emplace(update->sequence, update);
      return;
    }
    if (topic.who_is_ahead == side || other->second->stamp != update->stamp ||
        !(other->second->payload == update->payload)) {
      problem(*update, side, "which is not that of the other side");
    }
    topic.ahead.erase(other);
  }
  void problem(const api::Update& update, Side side, const std::string& what) {
    constexpr std::size_t kMost = 20;
    if (problems_.size() < kMost) {
      problems_.push_back((side == kReference ? "the reference has " : "the impaired client has ") +
                          std::string(api::to_string(update.topic)) + " " + std::to_string(update.sequence) + ", " +
                          what);
    }
  }
  void note_mission(const api::Update& update) {
    if (const auto* status = std::get_if<api::MissionStatus>(&update.payload); status != nullptr && status->end) {
      outcomes_[status->id] = api::to_string(status->end->outcome);
    }
    const auto* event = std::get_if<api::Event>(&update.payload);
    if (event == nullptr) {
      return;
    }
    if (event->kind == "mission-started") {
      ++begun_[event->mission];
      running_.insert(event->mission);
    } else if (event->kind == "mission-ended") {
      ++ended_[event->mission];
      running_.erase(event->mission);
    }
  }
  [[nodiscard]] bool level() const {
    return std::all_of(topics_.begin(), topics_.end(), [](const auto& topic) { return topic.second.ahead.empty(); });
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<api::Topic, Topic> topics_;
  std::vector<std::string> problems_;
  std::size_t items_ = 0;
  std::map<api::MissionId, int> begun_;
  std::map<api::MissionId, int> ended_;
  std::map<api::MissionId, std::string> outcomes_;
  std::set<api::MissionId> running_;
};

}  // namespace seeker::testing
