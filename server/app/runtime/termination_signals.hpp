/// \file
/// The signals that end a server.
#pragma once

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

namespace seeker::app {

/// SIGTERM and SIGINT as something one can wait for. They are blocked in every thread made afterwards.
class TerminationSignals {
 public:
  TerminationSignals() {
    sigemptyset(&set_);
    sigaddset(&set_, SIGTERM);
    sigaddset(&set_, SIGINT);
    pthread_sigmask(SIG_BLOCK, &set_, nullptr);
    std::signal(SIGPIPE, SIG_IGN);
    fd_ = signalfd(-1, &set_, SFD_CLOEXEC);
  }
  TerminationSignals(const TerminationSignals&) = delete;
  TerminationSignals& operator=(const TerminationSignals&) = delete;
  ~TerminationSignals() { close(fd_); }

  /// True when a signal came within the time.
  [[nodiscard]] bool wait(std::chrono::milliseconds limit) const {
    pollfd entry{.fd = fd_, .events = POLLIN, .revents = 0};
    return poll(&entry, 1, static_cast<int>(limit.count())) > 0;
  }

 private:
  sigset_t set_{};
  int fd_ = -1;
};

}  // namespace seeker::app
