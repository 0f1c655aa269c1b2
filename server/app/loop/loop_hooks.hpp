/// \file
/// LoopHooks are callbacks by which the journal, the store of maps, the recorder of drives and tests follow the loop.
#pragma once

#include <chrono>
#include <functional>
#include <string_view>

#include "common/api/robot_api.hpp"
#include "common/core/scan.hpp"
#include "server/app/state/checkpoint.hpp"
#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::app {

/// Wall time that the parts of one tick took.
struct TickTimes {
  std::chrono::steady_clock::time_point begun;
  Duration sense{};
  Duration estimate{};
  Duration decide{};  ///< and to act
  Duration publish{};
};

/// All are called on the loop's thread; one that is empty is not called.
struct LoopHooks {
  /// Called after every pass of the loop, also of one that only waits for its world: a loop that is stuck is silent.
  std::function<void(std::chrono::steady_clock::time_point)> on_pass;
  /// Called after every tick.
  std::function<void(const TickTimes&)> on_tick;
  /// Called instead while the loop rests on purpose.
  std::function<void()> on_idle;
  /// Called with the wall time that the work on one picture took, when its result is taken. `work` says what it was:
  /// "recogniser", "stereo" or "node-picture".
  std::function<void(std::string_view work, Duration took)> on_work;
  /// Called with every new odometry as the base measured it, without the calibration of its wheels.
  std::function<void(const drivers::OdometrySample&)> on_odometry;
  /// Called with every new scan, after the odometry of the same tick; the motion of the base is taken out of it.
  std::function<void(const LaserScan&)> on_scan;
  /// Called with every event, before it is published.
  std::function<void(const api::Event&)> on_event;
  /// Called with a request that has become the running mission, before any event of it.
  std::function<void(const api::MissionRequest&)> on_mission_started;
  /// Called with every mission status, before subscribers get it.
  std::function<void(const api::MissionStatus&)> on_mission;
  /// Called with every detection that is new, refined or withdrawn, before subscribers get it.
  std::function<void(const api::Detection&)> on_detection;
  /// Keeps the map of a mission that is building it; whoever does so must report by MissionCheckpoints::written().
  std::function<void(const api::MissionId&, Checkpoint)> on_checkpoint;
  /// Keeps where the robot is in that map; whoever does so must report by
  /// MissionCheckpoints::place_written().
  std::function<void(const api::MissionId&, const MissionPlace&)> on_place;
  /// Called when the robot was not found in the map that is kept for this mission, which goes on in a new map.
  std::function<void(const api::MissionId&)> on_checkpoint_unused;
  /// Called when no mission needs its checkpoints any more, so that they may be deleted.
  std::function<void()> on_checkpoints_void;
};

}  // namespace seeker::app
