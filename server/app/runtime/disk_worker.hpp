/// \file
/// A thread for reading and writing files, so that no tick waits for a disk.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "common/core/result.hpp"

namespace seeker::app {

class DiskWorker {
 public:
  using Work = std::function<void()>;

  /// At most `limit` pieces of work wait; `what` says what they are in the answer to one more, as in "maps".
  DiskWorker(std::size_t limit, std::string what);
  DiskWorker(const DiskWorker&) = delete;
  DiskWorker& operator=(const DiskWorker&) = delete;
  ~DiskWorker();

  /// Does it after what was posted before. kBusy when too much waits.
  [[nodiscard]] Status post(Work work);
  /// Does what was accepted, then ends; harmless when repeated. The end of the worker does so, too.
  void finish();

 private:
  void serve();

  const std::size_t limit_;
  const std::string what_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Work> queue_;
  bool quit_ = false;
  std::thread thread_;
};

/// What files are stamped with: seconds since 1970, UTC.
[[nodiscard]] std::int64_t wall_unix_s();

}  // namespace seeker::app
