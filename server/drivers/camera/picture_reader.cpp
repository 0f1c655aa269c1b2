#include "server/drivers/camera/picture_reader.hpp"

#include <utility>

namespace seeker::drivers {

PictureReader::PictureReader(std::string name, std::unique_ptr<PictureSource> source, NowFunction now,
                             const PictureReaderParams& params)
    : name_(std::move(name)), source_(std::move(source)), now_(std::move(now)), params_(params) {
  SEEKER_ASSERT(source_ != nullptr && now_ && params_.kept > 0);
}

PictureReader::~PictureReader() { stop(); }

void PictureReader::start() {
  stop();
  {
    const std::scoped_lock lock(mutex_);
    frames_.clear();
    error_.reset();
    started_ = now_();
    running_ = true;
    stopping_ = false;
  }
  thread_ = std::thread([this] { run(); });
}

void PictureReader::stop() {
  {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
    running_ = false;
  }
  changed_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void PictureReader::run() {
  do {
    read_until_it_fails();
  } while (source_->comes_back() && wait_to_reopen());
}

bool PictureReader::wait_to_reopen() {
  std::unique_lock lock(mutex_);
  return !changed_.wait_for(lock, params_.reopen_after, [this] { return stopping_; });
}

void PictureReader::read_until_it_fails() {
  Status opened = source_->open();
  while (true) {
    Result<Image> picture = opened ? source_->read() : Result<Image>(tl::unexpected<Error>(opened.error()));
    const RobotTime stamp = now_();
    const std::scoped_lock lock(mutex_);
    if (stopping_ || !picture) {
      if (!picture) {
        error_ = picture.error();
      }
      break;
    }
    error_.reset();
    frames_.push_back({stamp, std::move(*picture)});
    while (frames_.size() > params_.kept) {
      frames_.pop_front();
    }
    changed_.notify_all();
  }
  source_->close();
  changed_.notify_all();
}

Result<std::deque<CameraFrame>> PictureReader::pictures() const {
  const RobotTime now = now_();
  const std::scoped_lock lock(mutex_);
  if (error_) {
    return fail_with_context(name_, *error_);
  }
  if (!running_) {
    return fail(Errc::kNotReady, name_ + " is not active; activate it first");
  }
  if (frames_.empty() && now - started_ <= params_.first_picture) {
    return fail(Errc::kNotReady, name_ + " has given no picture yet");
  }
  std::deque<CameraFrame> fresh = frames_;
  while (!fresh.empty() && now - fresh.front().stamp > params_.max_age) {
    fresh.pop_front();
  }
  if (fresh.empty()) {
    return fail(Errc::kTimeout, name_ + " gives no pictures any more; check its cable or its network");
  }
  return fresh;
}

bool PictureReader::wait_for_picture(std::chrono::milliseconds limit) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, limit, [this] { return !frames_.empty() || error_.has_value(); });
}

}  // namespace seeker::drivers
