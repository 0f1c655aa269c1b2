#include "server/app/runtime/components.hpp"

#include <algorithm>
#include <utility>

#include "common/core/assert.hpp"

namespace seeker::app {
namespace {

constexpr std::size_t kRateSamples = 32;
constexpr Duration kRateWindow = std::chrono::seconds(5);

/// Values per second; 0 where the last one is long ago.
double rate_hz(const std::vector<RobotTime>& stamps, RobotTime now) {
  const bool fresh = stamps.size() >= 2 && now - stamps.back() <= kRateWindow;
  const double span_s = fresh ? to_seconds(stamps.back() - stamps.front()) : 0.0;
  return span_s > 0.0 ? static_cast<double>(stamps.size() - 1) / span_s : 0.0;
}

std::pair<std::string, std::string> split(const std::string& path) {
  const std::size_t dot = path.find('.');
  SEEKER_ASSERT(dot != std::string::npos);
  return {path.substr(0, dot), path.substr(dot + 1)};
}

}  // namespace

template <class Entries>
auto Components::find_in(Entries& entries, const std::string& name) -> decltype(entries.data()) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.info.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

void Components::add(const std::string& name, const std::string& kind, const std::string& type, ComponentHooks hooks,
                     std::vector<Port> ports) {
  SEEKER_ASSERT(find(name) == nullptr);
  Entry entry;
  entry.info.name = name;
  entry.info.kind = kind;
  entry.info.type = type;
  entry.info.state = api::ComponentState::kCreated;
  entry.hooks = std::move(hooks);
  for (Port& port : ports) {
    api::ComponentPort& info = entry.info.ports.emplace_back();
    info.name = std::move(port.name);
    info.type = std::move(port.type);
    info.output = port.output;
  }
  entries_.push_back(std::move(entry));
}

Status Components::known(const std::string& name) const {
  if (find(name) != nullptr) {
    return {};
  }
  std::string names;
  for (const Entry& each : entries_) {
    names += (names.empty() ? "" : ", ") + each.info.name;
  }
  return fail(Errc::kNotFound, "no component '" + name + "'; there are: " + names);
}

api::ComponentPort* Components::port_of(const std::string& path) {
  const auto [name, port] = split(path);
  Entry* entry = find(name);
  if (entry == nullptr) {
    return nullptr;
  }
  const auto found = std::find_if(entry->info.ports.begin(), entry->info.ports.end(),
                                  [&port = port](const api::ComponentPort& one) { return one.name == port; });
  return found == entry->info.ports.end() ? nullptr : &*found;
}

void Components::connect(const std::string& output, const std::string& input) {
  api::ComponentPort* from = port_of(output);
  api::ComponentPort* to = port_of(input);
  SEEKER_ASSERT(from != nullptr && to != nullptr && from->output && !to->output && from->type == to->type);
  from->connected.push_back(input);
  to->connected.push_back(output);
}

bool Components::connected(const std::string& output, const std::string& input) const {
  const auto [name, port] = split(output);
  const Entry* entry = find(name);
  return entry != nullptr &&
         std::any_of(entry->info.ports.begin(), entry->info.ports.end(),
                     [&, &port = port](const api::ComponentPort& one) {
                       return one.name == port &&
                              std::find(one.connected.begin(), one.connected.end(), input) != one.connected.end();
                     });
}

void Components::activate(Entry& entry) {
  const Status ok = entry.hooks.activate ? entry.hooks.activate() : Status();
  entry.info.state = ok ? api::ComponentState::kActive : api::ComponentState::kError;
  entry.info.last_error = ok ? "" : ok.error().message;
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

Status Components::activate(const std::string& name) {
  if (const Status ok = known(name); !ok) {
    return ok;
  }
  Entry& entry = *find(name);
  if (entry.info.state != api::ComponentState::kActive) {
    activate(entry);
  }
  return entry.info.state == api::ComponentState::kActive
             ? Status()
             : fail(Errc::kInternal, name + " did not start: " + entry.info.last_error);
}

Status Components::deactivate(const std::string& name) {
  if (const Status ok = known(name); !ok) {
    return ok;
  }
  Entry& entry = *find(name);
  if (entry.hooks.deactivate) {
    entry.hooks.deactivate();
  }
  entry.info.state = api::ComponentState::kInactive;
  entry.held_up = false;
  return {};
}

Status Components::restart(const std::string& name) {
  const Status stopped = deactivate(name);
  return stopped ? activate(name) : stopped;
}

void Components::set_type(const std::string& name, const std::string& type) {
  if (Entry* entry = find(name)) {
    entry->info.type = type;
  }
}

void Components::count_output(const std::string& name, const std::string& port, RobotTime now) {
  if (Entry* entry = find(name)) {
    std::vector<RobotTime>& stamps = entry->outputs[port];
    if (stamps.size() >= kRateSamples) {
      stamps.erase(stamps.begin());
    }
    stamps.push_back(now);
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
  const Entry* entry = find(name);
  return entry != nullptr && entry->info.state == api::ComponentState::kActive;
}

bool Components::stopped(const std::string& name) const { return find(name) != nullptr && !active(name); }

/// An input shows what the outputs give that are connected to it.
void Components::measure(const Entry& entry, api::ComponentPort& port, RobotTime now) const {
  std::vector<std::pair<const Entry*, std::string>> sources;
  if (port.output) {
    sources.emplace_back(&entry, port.name);
  } else {
    for (const std::string& output : port.connected) {
      const auto [name, source] = split(output);
      sources.emplace_back(find(name), source);
    }
  }
  for (const auto& [from, name] : sources) {
    const auto stamps = from->outputs.find(name);
    if (stamps == from->outputs.end()) {
      continue;
    }
    const Duration age = now - stamps->second.back();
    port.age = port.age ? std::min(*port.age, age) : age;
    port.rate_hz += from->info.state == api::ComponentState::kActive ? rate_hz(stamps->second, now) : 0.0;
  }
}

std::vector<api::ComponentInfo> Components::list(RobotTime now) const {
  std::vector<api::ComponentInfo> infos;
  for (const Entry& entry : entries_) {
    api::ComponentInfo info = entry.info;
    const bool works = info.state == api::ComponentState::kActive;
    for (const auto& [port, stamps] : entry.outputs) {
      info.rate_hz = std::max(info.rate_hz, works ? rate_hz(stamps, now) : 0.0);
    }
    for (api::ComponentPort& port : info.ports) {
      measure(entry, port, now);
    }
    info.link = entry.hooks.link ? entry.hooks.link() : std::nullopt;
    infos.push_back(std::move(info));
  }
  return infos;
}

}  // namespace seeker::app
