/// \file
/// What subscribers get of the robot, each topic at its own pace, and the status that clients ask for.
#pragma once

#include <cstdint>

#include "common/api/robot_api.hpp"
#include "common/core/time.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/localiser.hpp"
#include "server/app/loop/mission_resumption.hpp"
#include "server/app/loop/motion_control.hpp"
#include "server/app/loop/sensing.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/missions/mission_executor.hpp"
#include "server/app/runtime/update_hub.hpp"

namespace seeker::app {

/// Owner of what has been published so far. Lives on the loop's thread.
class Publisher {
 public:
  /// What it reports on. All outlive it.
  struct Sources {
    const WorldLink& world;
    const Sensing& sensing;
    Localiser& localiser;
    const MotionControl& motion;
    const MissionExecutor& missions;
    const MissionResumption& resumption;
    const Diagnostics& diagnostics;
  };

  Publisher(const LoopParams& params, const Sources& sources, UpdateHub& hub);

  /// Publishes what is new and due. Nobody gets what nobody has subscribed to.
  void publish();
  /// Everything that a new subscriber needs is published in the next publish().
  void republish() { republish_ = true; }
  [[nodiscard]] bool republishes() const { return republish_; }
  [[nodiscard]] api::RobotStatus status() const;

 private:
  void publish_readings(RobotTime stamp);
  void publish_tiles(RobotTime stamp);
  void publish_grid(RobotTime stamp);
  void publish_segments(RobotTime stamp);

  Duration tile_period_;
  Duration grid_period_;
  Sources sources_;
  UpdateHub& hub_;
  bool republish_ = false;
  std::uint64_t published_revision_ = 0;
  std::uint64_t published_segments_ = 0;
  RobotTime tiles_at_;
  RobotTime grid_at_;
};

}  // namespace seeker::app
