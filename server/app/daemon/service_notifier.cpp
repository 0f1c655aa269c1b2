#include "server/app/daemon/service_notifier.hpp"

#include <systemd/sd-daemon.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace seeker::app {
namespace {

/// A service manager that cannot be reached is no reason to stop a robot: it acts on the silence by itself.
void tell(const std::string& text) { static_cast<void>(sd_notify(0, text.c_str())); }

bool has_service_manager() { return std::getenv("NOTIFY_SOCKET") != nullptr; }

/// True once per period; the first time at once.
bool is_due(std::optional<ServiceNotifier::WallTime>& last, ServiceNotifier::WallTime now,
            std::chrono::microseconds period) {
  const bool due = !last || now - *last >= period;
  if (due) {
    last = now;
  }
  return due;
}

}  // namespace

std::string service_state(const api::RobotStatus& status) {
  std::string text = status.estop ? "emergency stop" : status.motors_armed ? "armed" : "disarmed";
  if (status.mission && !status.mission->end) {
    text += ", mission '" + status.mission->id + "' " + std::string(api::to_string(status.mission->state)) + ": " +
            status.mission->phase;
  } else {
    text += ", no mission";
  }
  if (!status.faults.empty()) {
    text += ", " + std::to_string(status.faults.size()) + " faults, the first: " + status.faults.front().message;
  }
  std::replace(text.begin(), text.end(), '\n', ' ');  // a line break would begin another assignment
  return text;
}

ServiceNotifier::ServiceNotifier() {
  std::uint64_t watchdog_us = 0;
  if (sd_watchdog_enabled(0, &watchdog_us) > 0) {
    beat_period_ = std::chrono::microseconds(watchdog_us / 2);
  }
}

void ServiceNotifier::ready() const { tell("READY=1"); }

void ServiceNotifier::stopping() const { tell("STOPPING=1\nSTATUS=stopping"); }

void ServiceNotifier::passed(WallTime now, const std::function<std::string()>& state) {
  if (beat_period_ && is_due(beat_at_, now, *beat_period_)) {
    tell("WATCHDOG=1");
  }
  if (has_service_manager() && is_due(state_at_, now, kServiceStatePeriod)) {
    if (std::string text = state(); text != state_) {
      state_ = std::move(text);
      tell("STATUS=" + state_);
    }
  }
}

}  // namespace seeker::app
