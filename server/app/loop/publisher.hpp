/// \file
/// Publisher sends each topic to its subscribers at its own pace, and builds the status that clients ask for.
#pragma once

#include <cstdint>

#include "common/api/robot_api.hpp"
#include "common/core/time.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/line_reporter.hpp"
#include "server/app/loop/localiser.hpp"
#include "server/app/loop/mission_resumption.hpp"
#include "server/app/loop/motion_control.hpp"
#include "server/app/loop/neighbours.hpp"
#include "server/app/loop/sensing.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/missions/mission_executor.hpp"
#include "server/app/runtime/update_hub.hpp"

namespace seeker::app {

/// Owns what has been published so far. Lives on the loop's thread.
class Publisher {
 public:
  /// The publisher reports on these objects; they must outlive it.
  struct Sources {
    const WorldLink& world;
    const Sensing& sensing;
    Localiser& localiser;
    const Neighbours& neighbours;
    const MotionControl& motion;
    const MissionExecutor& missions;
    const MissionResumption& resumption;
    const Diagnostics& diagnostics;
  };

  Publisher(const LoopParams& params, const lines::ExtractorParams& lines, const Sources& sources, UpdateHub& hub);

  /// Publishes with other periods from now on.
  void use(const LoopParams& params) {
    tile_period_ = params.tile_period;
    grid_period_ = params.grid_period;
    topology_period_ = params.topology_period;
  }
  /// Publishes what is new and due. A topic without subscribers is not built.
  void publish();
  /// Everything that a new subscriber needs is published in the next publish().
  void republish() { republish_ = true; }
  [[nodiscard]] bool republishes() const { return republish_; }
  /// Builds the robot's present status, as it is published and as clients ask for it.
  [[nodiscard]] api::RobotStatus status() const;

 private:
  void publish_readings(RobotTime stamp);
  void publish_tiles(RobotTime stamp);
  void publish_grid(RobotTime stamp);
  void publish_segments(RobotTime stamp);
  void publish_topology(RobotTime stamp);

  Duration tile_period_;
  Duration grid_period_;
  Duration topology_period_;
  Sources sources_;
  UpdateHub& hub_;
  LineReporter lines_;
  bool republish_ = false;
  std::uint64_t published_revision_ = 0;
  std::uint64_t published_segments_ = 0;
  RobotTime tiles_at_;
  RobotTime grid_at_;
  RobotTime topology_at_;
};

}  // namespace seeker::app
