/// \file
/// ClientCommands carries out what clients ask of a running robot.
#pragma once

#include <optional>
#include <string>

#include "common/api/robot_api.hpp"
#include "common/core/result.hpp"
#include "server/app/loop/component_commands.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/map_commands.hpp"
#include "server/app/loop/mission_control.hpp"
#include "server/app/loop/motion_control.hpp"
#include "server/app/loop/perception.hpp"
#include "server/app/loop/publisher.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/missions/mission_executor.hpp"

namespace seeker::app {

/// Each command checks what forbids it and names the remedy; `client` is the name of who asks. Owns nothing. Lives on
/// the loop's thread.
class ClientCommands {
 public:
  /// These objects carry the commands out; they must outlive ClientCommands.
  struct Parties {
    WorldLink& world;
    Perception& perception;
    MotionControl& motion;
    MissionExecutor& executor;
    MissionControl& missions;
    MapCommands& maps;
    ComponentCommands& components;
    Publisher& publisher;
    Diagnostics& diagnostics;
    const SituationSource& situation;
  };

  explicit ClientCommands(const Parties& parties) : parties_(parties) {}

  /// See MissionControl::start().
  [[nodiscard]] Result<api::MissionId> start_mission(const api::MissionRequest& request, const std::string& client);
  /// When the command resumes a mission that a crash cut off, `client` becomes its owner.
  [[nodiscard]] Status command_mission(api::MissionCommand command, const std::string& client);
  /// Ends the mission and stops the base; the holder of the lease must acquire it again to drive.
  void stop();
  /// Latches or releases the emergency stop; latching it pauses the mission. The log says who did it.
  void set_estop(bool engaged, const std::string& client = "");
  /// Acquires, renews, asks for, takes over or releases the lease; see Lease::command().
  [[nodiscard]] Result<api::LeaseState> command_lease(const api::Caller& caller, const api::LeaseCommand& command,
                                                      WallTime wall_now);
  /// Drives by hand with a velocity that expires: with the lease, at real time, while no mission runs.
  [[nodiscard]] Status drive(const std::string& client, const api::DriveCommand& command);
  /// Starts a component again. The robot is disarmed and its mission paused by that.
  [[nodiscard]] Status restart_component(const std::string& name) { return parties_.components.restart(name); }
  /// All that concerns components.
  [[nodiscard]] ComponentCommands& components() { return parties_.components; }
  /// See Cameras::grab().
  [[nodiscard]] Result<api::ImageFrame> grab_image(const std::string& camera);
  /// See MapCommands::load(). A mission that was cut off does not go on in this map.
  [[nodiscard]] Status load_map(const LineMap& map, const MapIdentity& identity);
  /// See MapCommands::relocalise().
  [[nodiscard]] Status relocalise(const std::optional<Pose2>& map_T_base);

  /// The client has been silent since then: its lease is stale, and its mission's link policy counts.
  void client_silent(const std::string& client, WallTime since);
  /// The connection of a client broke or was given up. Otherwise as client_silent().
  void client_lost(const std::string& client, const std::string& why, WallTime wall_now);
  /// The client has sent something again, or has connected again.
  void client_back(const std::string& client);
  /// The client left on purpose: it gives its lease up, its mission goes on.
  void client_closed(const std::string& client);
  /// Call it in each pass of the loop, also of one that makes no tick: requests for the lease time out, and link
  /// policies go on.
  void watch(WallTime wall_now);

 private:
  void note_lease(const api::LeaseState& before, const std::string& why_not = "");

  Parties parties_;
};

}  // namespace seeker::app
