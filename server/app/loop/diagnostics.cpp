#include "server/app/loop/diagnostics.hpp"

#include <utility>

namespace seeker::app {

Diagnostics::Diagnostics(std::shared_ptr<const drivers::Clock> clock, UpdateHub& hub, const LoopHooks& hooks)
    : clock_(std::move(clock)), hub_(hub), hooks_(hooks) {}

void Diagnostics::raise(const std::string& id, const std::string& component, const std::string& message,
                        const std::string& remedy, api::Severity severity) {
  if (faults_.raise({.id = id,
                     .component = component,
                     .severity = severity,
                     .onset = clock_->now(),
                     .message = message,
                     .remedy = remedy})) {
    log("fault", id + ": " + message, severity);
  }
}

bool Diagnostics::clear(const std::string& id) {
  const bool was_there = faults_.clear(id);
  if (was_there) {
    log("fault-cleared", id);
  }
  return was_there;
}

void Diagnostics::note_reading(const Status& status, const std::string& id) {
  if (!status) {
    raise(id, "pose", status.error().message, "the estimate goes on without this reading", api::Severity::kWarning);
  } else {
    clear(id);
  }
}

void Diagnostics::note_work(std::string_view work, Duration took) const {
  if (hooks_.on_work) {
    hooks_.on_work(work, took);
  }
}

void Diagnostics::log(const std::string& kind, const std::string& text, api::Severity severity) {
  emit({.sequence = 0,
        .stamp = clock_->now(),
        .mission_time = std::nullopt,
        .mission = "",
        .severity = severity,
        .kind = kind,
        .text = text});
}

void Diagnostics::emit(const api::Event& event) {
  api::Event numbered = event;
  numbered.sequence = ++event_sequence_;
  if (hooks_.on_event) {
    hooks_.on_event(event);
  }
  hub_.publish(api::Topic::kEvent, event.stamp, std::move(numbered));
}

}  // namespace seeker::app
