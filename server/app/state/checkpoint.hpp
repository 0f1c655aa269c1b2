/// \file
/// What a mission that builds a map keeps on disk, and goes on from when its program was cut off.
#pragma once

#include <optional>

#include "common/api/mission.hpp"
#include "server/app/maps/robot_map.hpp"
#include "server/app/missions/mission_executor.hpp"
#include "server/app/missions/mission_memory.hpp"

namespace seeker::app {

/// Where the robot is, and how far its mission has come.
struct MissionPlace {
  Pose2 map_T_base;
  MissionSoFar so_far;

  friend bool operator==(const MissionPlace&, const MissionPlace&) = default;
};

/// One moment: what the mission knows belongs to this state of the map.
struct Checkpoint {
  LoopMap map;
  MissionMemory memory;
  MissionPlace place;
};

/// What there is besides the map.
struct KeptState {
  std::optional<Pose2> map_T_base;  ///< where the robot was last, kept more often than the map
  MissionMemory memory = {};        ///< only what belongs to this state of the map
  MissionSoFar so_far = {};         ///< kept with map_T_base
};

}  // namespace seeker::app
