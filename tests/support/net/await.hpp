/// \file
/// Waiting for another thread without sleeping for a guessed time.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <vector>

namespace seeker::testing {

inline constexpr std::chrono::seconds kPatience{20};  ///< far above what a loaded machine needs

/// A list that one thread fills and another waits on.
template <class T>
class Recorder {
 public:
  void add(T item) {
    const std::lock_guard lock(mutex_);
    items_.push_back(std::move(item));
    changed_.notify_all();
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    items_.clear();
  }
  [[nodiscard]] std::vector<T> items() const {
    const std::lock_guard lock(mutex_);
    return items_;
  }
  /// True as soon as the predicate holds for the list; false when it does not within kPatience.
  template <class Predicate>
  [[nodiscard]] bool wait(Predicate&& holds) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return holds(items_); });
  }
  [[nodiscard]] bool wait_count(std::size_t n) {
    return wait([n](const std::vector<T>& items) { return items.size() >= n; });
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<T> items_;
};

/// Polls something that cannot notify (a counter of the server).
template <class Predicate>
[[nodiscard]] bool eventually(Predicate&& holds) {
  std::mutex mutex;
  std::condition_variable never;
  std::unique_lock lock(mutex);
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) {
      return false;
    }
    never.wait_for(lock, std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace seeker::testing
