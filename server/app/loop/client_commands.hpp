/// \file
/// What clients may ask of the robot while it runs.
#pragma once

#include <optional>
#include <string>

#include "common/api/robot_api.hpp"
#include "common/core/result.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/map_commands.hpp"
#include "server/app/loop/mission_control.hpp"
#include "server/app/loop/motion_control.hpp"
#include "server/app/loop/perception.hpp"
#include "server/app/loop/publisher.hpp"
#include "server/app/loop/sensing.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/missions/mission_executor.hpp"

namespace seeker::app {

/// Each command checks what forbids it and names the remedy; `client` is the name of who asks. Owns nothing. Lives on
/// the loop's thread.
class ClientCommands {
 public:
  /// Who carries the commands out. All outlive the commands.
  struct Parties {
    WorldLink& world;
    Sensing& sensing;
    Perception& perception;
    MotionControl& motion;
    MissionExecutor& executor;
    MissionControl& missions;
    MapCommands& maps;
    Publisher& publisher;
    Diagnostics& diagnostics;
  };

  explicit ClientCommands(const Parties& parties) : parties_(parties) {}

  [[nodiscard]] Result<api::MissionId> start_mission(const api::MissionRequest& request, const std::string& client);
  /// `client` becomes the owner of a mission that it has go on after a crash.
  [[nodiscard]] Status command_mission(api::MissionCommand command, const std::string& client);
  void stop();
  void set_estop(bool engaged);
  [[nodiscard]] Result<api::LeaseState> command_lease(const std::string& client, api::LeaseAction action);
  [[nodiscard]] Status drive(const std::string& client, const api::DriveCommand& command);
  [[nodiscard]] Status restart_component(const std::string& name);
  [[nodiscard]] Result<api::ImageFrame> grab_image(const std::string& camera);
  [[nodiscard]] Status load_map(const LineMap& map, const MapIdentity& identity);
  [[nodiscard]] Status relocalise(const std::optional<Pose2>& map_T_base);

  void client_lost(const std::string& client, const std::string& why, WallTime wall_now);
  void client_back(const std::string& client);
  /// The client left on purpose: its lease is free, its mission goes on.
  void client_closed(const std::string& client);

 private:
  Parties parties_;
};

}  // namespace seeker::app
