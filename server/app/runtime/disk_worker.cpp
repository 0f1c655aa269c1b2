#include "server/app/runtime/disk_worker.hpp"

#include <chrono>
#include <utility>

namespace seeker::app {

DiskWorker::DiskWorker(std::size_t limit, std::string what)
    : limit_(limit), what_(std::move(what)), thread_([this] { serve(); }) {}

DiskWorker::~DiskWorker() { finish(); }

void DiskWorker::finish() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

Status DiskWorker::post(Work work) {
  {
    const std::lock_guard lock(mutex_);
    if (quit_ || queue_.size() >= limit_) {
      return fail(Errc::kBusy, "too many " + what_ + " are being read and written; try again");
    }
    queue_.push_back(std::move(work));
  }
  wake_.notify_one();
  return {};
}

std::int64_t wall_unix_s() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

void DiskWorker::serve() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return quit_ || !queue_.empty(); });
    if (queue_.empty()) {
      return;
    }
    const Work next = std::move(queue_.front());
    queue_.pop_front();
    lock.unlock();
    next();
    lock.lock();
  }
}

}  // namespace seeker::app
