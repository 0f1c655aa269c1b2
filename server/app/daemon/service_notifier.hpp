/// \file
/// Reports of the daemon to systemd: that it is ready, that its loop runs, what the robot does.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "common/api/robot_state.hpp"

namespace seeker::app {

/// How often the line of `systemctl status` may change.
inline constexpr std::chrono::seconds kServiceStatePeriod{1};

/// One line for `systemctl status`: mission, whether the motors may be powered, faults.
[[nodiscard]] std::string service_state(const api::RobotStatus& status);

/// Speaks to the service manager that started this process (NOTIFY_SOCKET, WATCHDOG_USEC); without one, or where it
/// does not answer, every call does nothing. ready() and stopping() are for the thread of `main`, passed() for the
/// loop's.
class ServiceNotifier {
 public:
  using WallTime = std::chrono::steady_clock::time_point;

  /// Reads from the environment how often the service manager wants a sign of life.
  ServiceNotifier();

  /// Clients can connect.
  void ready() const;
  /// The end was asked for.
  void stopping() const;
  /// The loop has come around; call it from the loop's own thread after each pass and from nowhere else, so that a loop
  /// that is stuck gives no sign of life and systemd starts the program again. Sends at most two signs of life in the
  /// time in which systemd wants one, and `state()` at most every kServiceStatePeriod when it has changed.
  void passed(WallTime now, const std::function<std::string()>& state);

 private:
  std::optional<std::chrono::microseconds> beat_period_;  ///< nothing: no watchdog
  std::optional<WallTime> beat_at_;
  std::optional<WallTime> state_at_;
  std::string state_;
};

}  // namespace seeker::app
