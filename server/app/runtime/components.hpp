/// \file
/// Everything the loop is composed of is a component with a name and a lifecycle (spec S4.9). One in ERROR never
/// takes the loop down.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/api/robot_state.hpp"
#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker::app {

/// How to start and stop one part of the robot.
struct ComponentHooks {
  std::function<Status()> activate;
  std::function<void()> deactivate;
};

/// Registry and lifecycle: CREATED -> INACTIVE <-> ACTIVE -> ERROR -> (restart) ACTIVE.
class Components {
 public:
  void add(const std::string& name, const std::string& kind, const std::string& type, ComponentHooks hooks);
  /// Activates all; a failure leaves that one in ERROR and is reported, the others go on.
  void activate_all();
  void deactivate_all();
  /// Deactivates and activates again. kNotFound lists the names there are.
  [[nodiscard]] Status restart(const std::string& name);
  /// One output was produced at `now` (for the rate).
  void count_output(const std::string& name, RobotTime now);
  void set_error(const std::string& name, const std::string& message);
  /// Those of a kind that are active are in ERROR until go_on(): what they stand on is gone, not they.
  void hold_up(const std::string& kind, const std::string& message);
  void go_on();
  [[nodiscard]] bool active(const std::string& name) const;
  [[nodiscard]] std::vector<api::ComponentInfo> list(RobotTime now) const;

 private:
  struct Entry {
    api::ComponentInfo info;
    ComponentHooks hooks;
    std::vector<RobotTime> outputs;  ///< stamps of the newest outputs, at most kRateSamples
    bool held_up = false;
  };

  void activate(Entry& entry);
  [[nodiscard]] Entry* find(const std::string& name);

  std::vector<Entry> entries_;
};

}  // namespace seeker::app
