#include "server/drivers/link/device_thread.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include <boost/asio/post.hpp>

#include "common/log/log.hpp"

namespace seeker::drivers {
namespace asio = boost::asio;

DeviceThread::DeviceThread(std::string name, DeviceThreadParams params, std::shared_ptr<DeviceSession> session,
                           std::function<RobotTime()> now)
    : name_(std::move(name)),
      params_(std::move(params)),
      session_(std::move(session)),
      now_(std::move(now)),
      backoff_(params_.first_reopen, params_.longest_reopen) {}

void DeviceThread::start() {
  if (running_) {
    return;
  }
  running_ = true;
  lost_ = Error{Errc::kNotReady, to_string(params_.line) + " is being opened; it takes a few seconds"};
  io_.restart();
  closing_ = false;
  thread_ = std::thread([this] { run(); });
}

void DeviceThread::run() {
  const auto work = asio::make_work_guard(io_);
  open();
  io_.run();
  line_.reset();
  actions_.clear();
  writing_ = false;
  // Handlers of the closed line are called, and find it closed.
  io_.restart();
  io_.poll();
}

void DeviceThread::stop() {
  if (!running_) {
    return;
  }
  running_ = false;
  asio::post(io_, [this] { say_farewell(); });
  thread_.join();
}

void DeviceThread::wake() {
  asio::post(io_, [this] { serve(); });
}

Status DeviceThread::state() const {
  const std::lock_guard lock(mutex_);
  return lost_ ? Status(tl::unexpected<Error>(*lost_)) : session_->state();
}

LinkStatistics DeviceThread::statistics() const {
  const std::lock_guard lock(mutex_);
  return session_->statistics();
}

void DeviceThread::open() {
  open_line(io_, params_.line, params_.open_timeout,
            [this](Result<std::unique_ptr<Line>> line) { opened(std::move(line)); });
}

void DeviceThread::opened(Result<std::unique_ptr<Line>> line) {
  if (closing_) {
    return;
  }
  if (!line) {
    lose(line.error());
    return;
  }
  line_ = std::move(*line);
  log::debug(name_, to_string(params_.line) + " is open");
  {
    const std::lock_guard lock(mutex_);
    lost_.reset();
    session_->open(now_());
  }
  read();
  serve();
}

void DeviceThread::read() {
  line_->read([this](Result<std::span<const std::uint8_t>> bytes) {
    if (!bytes) {
      lose(bytes.error());
      return;
    }
    {
      const std::lock_guard lock(mutex_);
      session_->receive(*bytes, now_());
    }
    // First the next read: serve() may close the line.
    read();
    serve();
  });
}

void DeviceThread::lose(const Error& why) {
  bool first = false;
  {
    const std::lock_guard lock(mutex_);
    first = !lost_ || lost_->message != why.message;
    lost_ = why;
    session_->line_lost();
  }
  line_.reset();
  actions_.clear();
  writing_ = false;
  timer_.cancel();
  if (closing_) {
    io_.stop();
    return;
  }
  if (first) {
    log::warning(name_, why.message);
  }
  reopen_.expires_after(backoff_.next());
  reopen_.async_wait([this](const boost::system::error_code& error) {
    if (!error && !closing_) {
      open();
    }
  });
}

void DeviceThread::serve() {
  if (line_ == nullptr) {
    return;
  }
  std::optional<Error> hopeless;
  {
    const std::lock_guard lock(mutex_);
    const RobotTime now = now_();
    if (session_->wake() <= now) {
      session_->pass(now);
    }
    for (LineAction& action : session_->take_actions()) {
      actions_.push_back(std::move(action));
    }
    const Status state = session_->state();
    if (state) {
      backoff_.reset();
    } else if (session_->wants_reopen() && !closing_) {
      hopeless = state.error();
    }
  }
  if (hopeless) {
    lose(*hopeless);
    return;
  }
  carry_out();
  set_timer();
}

void DeviceThread::carry_out() {
  while (line_ != nullptr && !writing_ && !actions_.empty()) {
    const LineAction action = std::move(actions_.front());
    actions_.pop_front();
    if (const Status applied = apply(action); !applied) {
      lose(applied.error());
    }
  }
  finish_when_written();
}

Status DeviceThread::apply(const LineAction& action) {
  if (const auto* write = std::get_if<WriteBytes>(&action)) {
    writing_ = true;
    line_->write(write->bytes, [this](const Status& written) {
      writing_ = false;
      if (written) {
        carry_out();
      } else {
        lose(written.error());
      }
    });
  } else if (const auto* baud = std::get_if<SetBaud>(&action)) {
    return line_->set_baud(baud->baud);
  } else if (const auto* dtr = std::get_if<SetDtr>(&action)) {
    line_->set_dtr(dtr->on);
  } else {
    line_->drop_input();
  }
  return {};
}

void DeviceThread::set_timer() {
  if (line_ == nullptr) {
    return;
  }
  constexpr Duration kLongest = std::chrono::seconds(1);
  Duration wait{};
  {
    const std::lock_guard lock(mutex_);
    wait = std::clamp(session_->wake() - now_(), Duration::zero(), kLongest);
  }
  timer_.expires_after(wait);
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (!error) {
      serve();
    }
  });
}

void DeviceThread::say_farewell() {
  closing_ = true;
  reopen_.cancel();
  if (line_ == nullptr) {
    io_.stop();
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    session_->close(now_());
  }
  serve();
  // A device that does not take its farewell must not hold the robot up.
  reopen_.expires_after(params_.farewell);
  reopen_.async_wait([this](const boost::system::error_code& error) {
    if (!error) {
      io_.stop();
    }
  });
}

void DeviceThread::finish_when_written() {
  if (closing_ && !writing_ && actions_.empty()) {
    io_.stop();
  }
}

}  // namespace seeker::drivers
