/// \file
/// A service manager as seen by the program that it starts: a socket to which the program reports.
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace seeker::testing {

/// Sets NOTIFY_SOCKET and WATCHDOG_USEC of this process and of those that it starts, until it is destroyed.
class ServiceManager {
 public:
  /// Zero: it has no watchdog.
  explicit ServiceManager(std::chrono::microseconds watchdog = {}) {
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    // A name that is no file (its first byte is 0): the path of a deep folder would not fit.
    const std::string name = "seeker-test-" + std::to_string(getpid());
    name.copy(&address.sun_path[1], sizeof(address.sun_path) - 1);
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), size), 0) << name;
    setenv("NOTIFY_SOCKET", ("@" + name).c_str(), 1);
    if (watchdog.count() > 0) {
      setenv("WATCHDOG_USEC", std::to_string(watchdog.count()).c_str(), 1);
    }
  }
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;
  ~ServiceManager() {
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    close(socket_);
  }

  /// The next report; nothing when none comes within `limit`.
  [[nodiscard]] std::optional<std::string> next(std::chrono::milliseconds limit) const {
    pollfd entry{.fd = socket_, .events = POLLIN, .revents = 0};
    if (poll(&entry, 1, static_cast<int>(limit.count())) <= 0) {
      return std::nullopt;
    }
    std::array<char, 4096> bytes{};
    const ssize_t size = recv(socket_, bytes.data(), bytes.size(), 0);
    return std::string(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  }

  /// What has been reported by now.
  [[nodiscard]] std::vector<std::string> reports() const {
    std::vector<std::string> all;
    while (std::optional<std::string> one = next({})) {
      all.push_back(std::move(*one));
    }
    return all;
  }

  /// True when this is reported within `limit`; what comes before it is passed over.
  [[nodiscard]] bool hears(const std::string& report, std::chrono::milliseconds limit) const {
    const auto end = std::chrono::steady_clock::now() + limit;
    const auto left = [&] {
      return std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    };
    for (std::chrono::milliseconds rest = limit; rest.count() > 0; rest = left()) {
      const std::optional<std::string> one = next(rest);
      if (one && one->find(report) != std::string::npos) {
        return true;
      }
    }
    return false;
  }

 private:
  int socket_ = -1;
};

}  // namespace seeker::testing
