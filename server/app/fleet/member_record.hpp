/// \file
/// What the main robot keeps of one of the others on its disk.
#pragma once

#include <optional>

#include "common/api/fleet.hpp"
#include "common/core/topology.hpp"
#include "server/app/fleet/fleet_pieces.hpp"
#include "server/app/fleet/robot_report.hpp"

namespace seeker::app {

/// Searched floor is not kept, since its age would not be known.
struct MemberRecord {
  api::FleetManifest manifest;
  Pieces pieces;
  bool split = false;             ///< the operator has taken the robot out
  std::optional<Pose2> accepted;  ///< main_T_map that the operator has accepted
  std::optional<RobotTopology> topology;
  RobotReport::Finds finds;
};

}  // namespace seeker::app
