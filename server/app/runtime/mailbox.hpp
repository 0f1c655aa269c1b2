/// \file
/// How other threads reach the robot loop, and the only means: a bounded queue of short tasks.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <vector>

namespace seeker::app {

/// Many producers, one consumer. A full mailbox refuses: the producer answers its client with kBusy.
class Mailbox {
 public:
  using Task = std::function<void()>;

  explicit Mailbox(std::size_t capacity) : capacity_(capacity) {}

  /// False when the mailbox is full or closed.
  [[nodiscard]] bool post(Task task) {
    {
      const std::lock_guard lock(mutex_);
      if (closed_ || tasks_.size() >= capacity_) {
        return false;
      }
      tasks_.push_back(std::move(task));
    }
    ready_.notify_one();
    return true;
  }

  /// Runs what is waiting now. Tasks posted meanwhile wait for the next call, so that the caller always returns.
  void run_pending() {
    std::deque<Task> batch;
    {
      const std::lock_guard lock(mutex_);
      batch.swap(tasks_);
    }
    for (Task& task : batch) {
      task();
    }
  }

  /// Sleeps until there is something to run, `limit` has passed or close() was called.
  void wait(std::chrono::milliseconds limit) {
    std::unique_lock lock(mutex_);
    ready_.wait_for(lock, limit, [this] { return closed_ || !tasks_.empty(); });
  }

  /// Refuses new tasks and wakes the consumer; what was accepted still runs.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    ready_.notify_all();
  }

  [[nodiscard]] bool closed() const {
    const std::lock_guard lock(mutex_);
    return closed_;
  }

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable ready_;
  std::deque<Task> tasks_;
  bool closed_ = false;
};

}  // namespace seeker::app
