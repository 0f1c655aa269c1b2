#include "server/app/recognition_runner.hpp"

#include <utility>

#include "common/core/assert.hpp"

namespace seeker::app {
namespace {

/// Exceptions of the vision library stop here.
Result<Recognition> recognise(RecognitionJob job) {
  try {
    Result<vision::RecognitionReport> report = job.recogniser->recognise(job.image);
    if (!report) {
      return tl::unexpected<Error>(report.error());
    }
    job.context.sightings = std::move(report->sightings);
    return std::move(job.context);
  } catch (const std::exception& error) {
    return fail(Errc::kInternal, std::string("the recogniser failed on a picture: ") + error.what());
  }
}

}  // namespace

RecognitionRunner::RecognitionRunner(bool inline_mode) : inline_mode_(inline_mode) {
  if (!inline_mode_) {
    worker_ = std::thread([this] { work(); });
  }
}

RecognitionRunner::~RecognitionRunner() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  wake_.notify_all();
  if (worker_.joinable()) {
    worker_.join();
  }
}

bool RecognitionRunner::busy() const {
  const std::lock_guard lock(mutex_);
  return job_ || working_ || answer_;
}

void RecognitionRunner::start(RecognitionJob job) {
  SEEKER_ASSERT(job.recogniser != nullptr && !busy());
  if (inline_mode_) {
    answer_ = recognise(std::move(job));
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    job_ = std::move(job);
  }
  wake_.notify_all();
}

std::optional<Result<Recognition>> RecognitionRunner::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(answer_, std::nullopt);
}

void RecognitionRunner::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return quit_ || job_.has_value(); });
    if (quit_) {
      return;
    }
    RecognitionJob job = std::move(*job_);
    job_.reset();
    working_ = true;
    lock.unlock();
    Result<Recognition> answer = recognise(std::move(job));
    lock.lock();
    working_ = false;
    answer_ = std::move(answer);
  }
}

}  // namespace seeker::app
