/// \file
/// Everything the loop is composed of is a component with a name, a lifecycle and ports (spec S4.9). One in ERROR never
/// takes the loop down.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/api/component.hpp"
#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker::app {

/// How to start and stop one part of the robot, and to ask for the counts of its line. An empty hook does nothing.
struct ComponentHooks {
  std::function<Status()> activate;
  std::function<void()> deactivate;
  std::function<std::optional<api::ComponentLink>()> link;
};

/// An input or an output of a component; `type` names its values.
struct Port {
  std::string name;
  std::string type;
  bool output = false;
};

/// Registry and lifecycle: CREATED -> ACTIVE <-> INACTIVE, and ERROR where activation fails. Lives on the loop's
/// thread.
class Components {
 public:
  void add(const std::string& name, const std::string& kind, const std::string& type, ComponentHooks hooks,
           std::vector<Port> ports = {});
  /// Connects an output with an input, each "component.port". Both must have been added.
  void connect(const std::string& output, const std::string& input);
  /// True when that output feeds that input.
  [[nodiscard]] bool connected(const std::string& output, const std::string& input) const;

  /// Activates all; a failure leaves that one in ERROR and is reported, the others go on.
  void activate_all();
  void deactivate_all();
  /// These return kNotFound, whose message lists the names there are, for an unknown name. activate() returns
  /// kInternal when the component did not start; one that is active stays so.
  [[nodiscard]] Status known(const std::string& name) const;
  [[nodiscard]] Status activate(const std::string& name);
  [[nodiscard]] Status deactivate(const std::string& name);
  /// Deactivates and activates again.
  [[nodiscard]] Status restart(const std::string& name);
  /// Notes that a component has been exchanged for another of that type.
  void set_type(const std::string& name, const std::string& type);

  /// A value left the output `port` of the component at `now`.
  void count_output(const std::string& name, const std::string& port, RobotTime now);
  void set_error(const std::string& name, const std::string& message);
  /// Those of a kind that are active are in ERROR until go_on(): what they stand on is gone, not they.
  void hold_up(const std::string& kind, const std::string& message);
  void go_on();
  [[nodiscard]] bool active(const std::string& name) const;
  /// True when there is such a component and it is not active: its work is not to be done.
  [[nodiscard]] bool stopped(const std::string& name) const;
  [[nodiscard]] std::vector<api::ComponentInfo> list(RobotTime now) const;

 private:
  struct Entry {
    api::ComponentInfo info;
    ComponentHooks hooks;
    /// By port: stamps of the newest values, at most kRateSamples.
    std::map<std::string, std::vector<RobotTime>> outputs;
    bool held_up = false;
  };

  void activate(Entry& entry);
  template <class Entries>
  [[nodiscard]] static auto find_in(Entries& entries, const std::string& name) -> decltype(entries.data());
  [[nodiscard]] const Entry* find(const std::string& name) const { return find_in(entries_, name); }
  [[nodiscard]] Entry* find(const std::string& name) { return find_in(entries_, name); }
  [[nodiscard]] api::ComponentPort* port_of(const std::string& path);
  void measure(const Entry& entry, api::ComponentPort& port, RobotTime now) const;

  std::vector<Entry> entries_;
};

}  // namespace seeker::app
