/// \file
/// ComponentCommands starts, stops, sets and exchanges components while the robot runs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/api/component.hpp"
#include "common/core/result.hpp"
#include "server/app/loop/configuration.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/localiser.hpp"
#include "server/app/loop/loop_params.hpp"
#include "server/app/loop/map_commands.hpp"
#include "server/app/loop/mission_control.hpp"
#include "server/app/loop/motion_control.hpp"
#include "server/app/loop/neighbours.hpp"
#include "server/app/loop/publisher.hpp"
#include "server/app/loop/sensing.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/missions/mission_executor.hpp"

namespace seeker::app {

/// Owns the configuration. Every change is an event. Lives on the loop's thread.
class ComponentCommands {
 public:
  /// These objects take part in changes; they must outlive ComponentCommands.
  struct Parties {
    WorldLink& world;
    Sensing& sensing;
    Neighbours& neighbours;
    Localiser& localiser;
    MotionControl& motion;
    MissionExecutor& executor;
    MissionControl& missions;
    MapCommands& maps;
    Publisher& publisher;
    Diagnostics& diagnostics;
  };

  /// `configuration` may be null: nothing can be set or exchanged then.
  ComponentCommands(const Parties& parties, const Devices& devices, std::shared_ptr<Configuration> configuration);

  /// Starts all components; one that fails is a fault, and the others go on.
  void start();
  /// Starts a component again. The robot is disarmed and its mission paused by that.
  [[nodiscard]] Status restart(const std::string& name);
  /// Activates or deactivates a component. One that is not active is a fault that holds the robot still.
  [[nodiscard]] Status switch_to(const std::string& name, bool active);
  /// Exchanges a component between missions; with the estimator a new map begins where the robot is.
  [[nodiscard]] Status exchange(const std::string& name, const std::string& type);
  /// Returns the settings of a component; kNotFound lists the components there are.
  [[nodiscard]] Result<std::vector<api::ComponentSetting>> settings(const std::string& name) const;
  /// Changes settings, all or none; returns the changed ones.
  [[nodiscard]] Result<std::vector<api::ComponentSetting>> set(const std::string& name,
                                                               const std::vector<std::string>& assignments);

 private:
  [[nodiscard]] Status known(const std::string& name) const;
  void changed_state(const std::string& name);
  void raise_failed(const std::string& name, const std::string& message);
  [[nodiscard]] Status use_period(const std::string& name, Duration period);
  void use(const LoopParams& params);
  void use_estimator(std::unique_ptr<Estimator> estimator);

  Parties parties_;
  Devices devices_;
  std::shared_ptr<Configuration> configuration_;
};

}  // namespace seeker::app
