/// \file
/// RobotLoop owns the robot's state and runs sense, estimate, decide, act and publish in every tick
/// (docs/architecture.md). Everything here runs on one thread; others reach it through a Mailbox.
#pragma once

#include "common/api/robot_api.hpp"
#include "server/app/loop/client_commands.hpp"
#include "server/app/loop/component_commands.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/localiser.hpp"
#include "server/app/loop/loop_hooks.hpp"
#include "server/app/loop/loop_params.hpp"
#include "server/app/loop/map_commands.hpp"
#include "server/app/loop/mission_control.hpp"
#include "server/app/loop/motion_control.hpp"
#include "server/app/loop/neighbours.hpp"
#include "server/app/loop/perception.hpp"
#include "server/app/loop/publisher.hpp"
#include "server/app/loop/sensing.hpp"
#include "server/app/loop/situation_source.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/missions/mission_executor.hpp"
#include "server/app/runtime/devices.hpp"
#include "server/app/runtime/update_hub.hpp"

namespace seeker::app {

/// Puts its collaborators together and gives each its turn in a tick; each of them owns one part of the robot's state.
class RobotLoop {
 public:
  RobotLoop(const LoopParams& params, LoopParts parts, UpdateHub& hub);
  ~RobotLoop();
  RobotLoop(const RobotLoop&) = delete;
  RobotLoop& operator=(const RobotLoop&) = delete;

  /// Starts the components and takes the first readings. Faults are reported, not returned: the loop always runs.
  void start();
  /// Runs one pass, at the end of which robot time has advanced by one period.
  void tick(WallTime wall_now);
  /// Waits at most `limit` of wall time until a world that is shared with others has finished the tick; false when it
  /// has not yet. A world that cannot be reached is a fault at once, and the end of a mission when it lasts.
  [[nodiscard]] bool await(Duration limit, WallTime wall_now);
  /// True when nothing would change by ticking: a simulated world stands still while no mission runs.
  [[nodiscard]] bool idle() const;
  /// Publishes what subscribers need while the world stands still.
  void publish_idle();
  /// Halts the base and stops the components.
  void shut_down();

  [[nodiscard]] RobotTime now() const { return world_.now(); }
  [[nodiscard]] api::RobotStatus status() const { return publisher_.status(); }
  [[nodiscard]] std::vector<std::string> capabilities() const;
  [[nodiscard]] const RobotMap& robot_map() const { return localiser_.map(); }
  /// Returns the callbacks, which must be set before start().
  [[nodiscard]] LoopHooks& hooks() { return hooks_; }

  [[nodiscard]] ClientCommands& commands() { return commands_; }
  [[nodiscard]] MapCommands& maps() { return maps_; }
  [[nodiscard]] MissionExecutor& missions() { return executor_; }
  [[nodiscard]] const MissionExecutor& missions() const { return executor_; }
  [[nodiscard]] MissionControl& mission_control() { return missions_; }
  [[nodiscard]] Neighbours& neighbours() { return neighbours_; }
  [[nodiscard]] const Neighbours& neighbours() const { return neighbours_; }
  [[nodiscard]] const Perception& perception() const { return perception_; }
  [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }
  [[nodiscard]] Publisher& publisher() { return publisher_; }
  [[nodiscard]] WorldLink& world() { return world_; }
  [[nodiscard]] const WorldLink& world() const { return world_; }
  [[nodiscard]] const Trajectory& trajectory() const { return localiser_.trajectory(); }

 private:
  [[nodiscard]] MissionOutputs mission_outputs(UpdateHub& hub);
  void sense();
  void estimate();
  [[nodiscard]] Twist2 decide(WallTime wall_now);
  void publish();
  void watch_world(WallTime wall_now);
  void end_source(const Error& error);

  LoopHooks hooks_;
  Devices devices_;
  Diagnostics diagnostics_;
  WorldLink world_;
  Sensing sensing_;
  Neighbours neighbours_;
  Localiser localiser_;
  SituationSource situation_;
  MotionControl motion_;
  MissionExecutor executor_;
  Perception perception_;
  MapCommands maps_;
  MissionControl missions_;
  Publisher publisher_;
  ComponentCommands components_;
  ClientCommands commands_;
};

}  // namespace seeker::app
