/// \file
/// Slow work of the loop, one piece at a time: inline in lockstep, on a worker thread when live.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "common/core/assert.hpp"
#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker::app {

template <class T>
class Background {
 public:
  using Work = std::function<Result<T>()>;

  /// `what` is named where the work throws: exceptions of the vision library stop here.
  Background(bool inline_mode, std::string what) : inline_mode_(inline_mode), what_(std::move(what)) {
    if (!inline_mode_) {
      worker_ = std::thread([this] { serve(); });
    }
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;
  ~Background() {
    {
      const std::lock_guard lock(mutex_);
      quit_ = true;
    }
    wake_.notify_all();
    if (worker_.joinable()) {
      worker_.join();
    }
  }

  /// True while work is being done or its answer waits.
  [[nodiscard]] bool busy() const {
    const std::lock_guard lock(mutex_);
    return work_ || working_ || answer_;
  }
  /// Starts one; must not be busy.
  void start(Work work) {
    SEEKER_ASSERT(work != nullptr && !busy());
    if (inline_mode_) {
      const WallTime begun = std::chrono::steady_clock::now();
      answer_ = guarded(work);
      took_ = std::chrono::steady_clock::now() - begun;
      return;
    }
    {
      const std::lock_guard lock(mutex_);
      work_ = std::move(work);
    }
    wake_.notify_all();
  }
  /// The answer, once it is there.
  [[nodiscard]] std::optional<Result<T>> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(answer_, std::nullopt);
  }
  /// Wall time that the newest answer took.
  [[nodiscard]] Duration took() const {
    const std::lock_guard lock(mutex_);
    return took_;
  }

 private:
  using WallTime = std::chrono::steady_clock::time_point;

  Result<T> guarded(const Work& work) const {
    try {
      return work();
    } catch (const std::exception& error) {
      return fail(Errc::kInternal, what_ + ": " + error.what());
    }
  }
  void serve() {
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [this] { return quit_ || work_; });
      if (quit_) {
        return;
      }
      const Work work = std::exchange(work_, nullptr);
      working_ = true;
      lock.unlock();
      const WallTime begun = std::chrono::steady_clock::now();
      Result<T> answer = guarded(work);
      const Duration took = std::chrono::steady_clock::now() - begun;
      lock.lock();
      working_ = false;
      took_ = took;
      answer_ = std::move(answer);
    }
  }

  const bool inline_mode_;
  const std::string what_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool quit_ = false;
  Work work_;
  bool working_ = false;
  std::optional<Result<T>> answer_;
  Duration took_{};
  std::thread worker_;
};

}  // namespace seeker::app
