#include "server/app/runtime/components.hpp"

#include <algorithm>
#include <utility>

#include "common/core/assert.hpp"

namespace seeker::app {
namespace {

constexpr std::size_t kRateSamples = 32;
constexpr Duration kRateWindow = std::chrono::seconds(5);

}  // namespace

void Components::add(const std::string& name, const std::string& kind, const std::string& type, ComponentHooks hooks) {
  SEEKER_ASSERT(find(name) == nullptr);
  Entry entry;
  entry.info = {.name = name, .kind = kind, .type = type, .state = api::ComponentState::kInactive, .last_error = {}};
  entry.hooks = std::move(hooks);
  entries_.push_back(std::move(entry));
}

Components::Entry* Components::find(const std::string& name) {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.info.name == name; });
  return found == entries_.end() ? nullptr : &*found;
}

void Components::activate(Entry& entry) {
  const Status ok = entry.hooks.activate ? entry.hooks.activate() : Status();
  entry.info.state = ok ? api::ComponentState::kActive : api::ComponentState::kError;
  if (!ok) {
    entry.info.last_error = ok.error().message;
  }
}

void Components::activate_all() {
  for (Entry& entry : entries_) {
    activate(entry);
  }
}

void Components::deactivate_all() {
  // The last started stops first: the base, registered first, outlives those that use it.
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
    if (entry->info.state == api::ComponentState::kActive && entry->hooks.deactivate) {
      entry->hooks.deactivate();
    }
    entry->info.state = api::ComponentState::kInactive;
  }
}

Status Components::restart(const std::string& name) {
  Entry* entry = find(name);
  if (entry == nullptr) {
    std::string names;
    for (const Entry& each : entries_) {
      names += (names.empty() ? "" : ", ") + each.info.name;
    }
    return fail(Errc::kNotFound, "no component '" + name + "'; there are: " + names);
  }
  if (entry->hooks.deactivate) {
    entry->hooks.deactivate();
  }
  activate(*entry);
  if (entry->info.state == api::ComponentState::kError) {
    return fail(Errc::kInternal, name + " did not start: " + entry->info.last_error);
  }
  return {};
}

void Components::count_output(const std::string& name, RobotTime now) {
  if (Entry* entry = find(name)) {
    if (entry->outputs.size() >= kRateSamples) {
      entry->outputs.erase(entry->outputs.begin());
    }
    entry->outputs.push_back(now);
  }
}

void Components::set_error(const std::string& name, const std::string& message) {
  if (Entry* entry = find(name)) {
    entry->info.state = api::ComponentState::kError;
    entry->info.last_error = message;
  }
}

void Components::hold_up(const std::string& kind, const std::string& message) {
  for (Entry& entry : entries_) {
    if (entry.info.kind == kind && entry.info.state == api::ComponentState::kActive) {
      entry.held_up = true;
      entry.info.state = api::ComponentState::kError;
      entry.info.last_error = message;
    }
  }
}

void Components::go_on() {
  for (Entry& entry : entries_) {
    if (std::exchange(entry.held_up, false)) {
      entry.info.state = api::ComponentState::kActive;
      entry.info.last_error.clear();
    }
  }
}

bool Components::active(const std::string& name) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.info.name == name && entry.info.state == api::ComponentState::kActive;
  });
}

std::vector<api::ComponentInfo> Components::list(RobotTime now) const {
  std::vector<api::ComponentInfo> infos;
  for (const Entry& entry : entries_) {
    api::ComponentInfo info = entry.info;
    const bool works = info.state == api::ComponentState::kActive;
    const bool fresh = works && entry.outputs.size() >= 2 && now - entry.outputs.back() <= kRateWindow;
    const double span_s = fresh ? to_seconds(entry.outputs.back() - entry.outputs.front()) : 0.0;
    info.rate_hz = span_s > 0.0 ? static_cast<double>(entry.outputs.size() - 1) / span_s : 0.0;
    infos.push_back(std::move(info));
  }
  return infos;
}

}  // namespace seeker::app
