/// \file
/// A robot's part in a fleet: main robot, one that joins it, or none.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "server/app/fleet/fleet_follower.hpp"
#include "server/app/fleet/fleet_leader.hpp"
#include "server/app/fleet/fleet_server.hpp"
#include "server/app/fleet/fleet_settings.hpp"
#include "server/app/fleet/own_map.hpp"

namespace seeker::app {

/// Destroy it before the robot that is its host.
struct FleetPart {
  std::unique_ptr<FleetLeader> leader;
  std::unique_ptr<FleetServer> server;
  std::unique_ptr<FleetFollower> follower;
};

/// Starts what the settings ask for. A main robot keeps what the others sent in `folder`, and writes the port that they
/// reach it at to the file `port` there. kInvalidArgument: leads and joins at once, or no address; kIo.
[[nodiscard]] Result<FleetPart> start_fleet(const FleetSettings& settings, const std::string& robot_id,
                                            const std::string& software_version, const std::filesystem::path& folder,
                                            const FleetHost& host);

}  // namespace seeker::app
