/// \file
/// What the loop calls outside of itself: the journal, the store of maps, tests.
#pragma once

#include <functional>

#include "common/api/robot_api.hpp"
#include "server/app/state/checkpoint.hpp"

namespace seeker::app {

/// All are called on the loop's thread; one that is empty is not called.
struct LoopHooks {
  /// Called with every event, before it is published.
  std::function<void(const api::Event&)> on_event;
  std::function<void(const api::MissionRequest&)> on_mission_started;
  std::function<void(const api::MissionStatus&)> on_mission;
  std::function<void(const api::Detection&)> on_detection;
  /// Keeps the map of a mission that is building it; the answer is MissionCheckpoints::written().
  std::function<void(const api::MissionId&, Checkpoint)> on_checkpoint;
  /// Keeps where the robot is in that map; the answer is MissionCheckpoints::place_written().
  std::function<void(const api::MissionId&, const MissionPlace&)> on_place;
  /// The robot was not found in the map that is kept for a mission, which goes on without it.
  std::function<void(const api::MissionId&)> on_checkpoint_unused;
  /// No mission needs its checkpoint any more.
  std::function<void()> on_checkpoints_void;
};

}  // namespace seeker::app
