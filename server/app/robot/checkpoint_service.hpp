/// \file
/// Maps of missions that are building them, kept on disk so that a mission goes on in its map after a crash.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "common/api/robot_api.hpp"
#include "server/app/loop/robot_loop.hpp"
#include "server/app/robot/map_store.hpp"
#include "server/app/runtime/mailbox.hpp"
#include "server/app/state/checkpoint.hpp"
#include "server/store/map_files.hpp"

namespace seeker::app {

/// Asked in the loop's thread before something begins that was asked for earlier; fails once a stop came after that.
using StillWanted = std::function<Status()>;

/// The other end of the loop's hooks about checkpoints: files are read and written on the store's worker, the loop gets
/// the answers through its mailbox. Outlives neither store, loop nor mailbox; its end finishes what was accepted.
class CheckpointService {
 public:
  CheckpointService(MapStore& store, RobotLoop& loop, Mailbox& mailbox);
  CheckpointService(const CheckpointService&) = delete;
  CheckpointService& operator=(const CheckpointService&) = delete;
  ~CheckpointService();

  /// Keeps the map of a running mission; the loop gets the answer. From the loop's thread.
  void write(const api::MissionId& mission, Checkpoint checkpoint);
  /// Keeps where the robot is in it; the loop gets an answer when that is done.
  void write_place(const api::MissionId& mission, const MissionPlace& place);
  /// Saves the map of a mission that did not go on in it under a name of its own.
  void set_aside(const api::MissionId& mission);
  void drop();

  /// Goes on with a paused mission, or with one that a crash cut off: in the map it had built, where that was kept, and
  /// unless a stop comes while that is read. Any thread.
  void resume_mission(const std::string& client, const StillWanted& still_wanted, const api::Reply<void>& reply);

 private:
  void report(const std::string& kind, const std::string& text, api::Severity severity);
  void resume_from(const api::MissionId& mission, const std::string& client, const StillWanted& still_wanted,
                   const api::Reply<void>& reply);

  MapStore& store_;
  RobotLoop& loop_;
  Mailbox& mailbox_;
  std::filesystem::path folder_;
  store::MapFiles files_;  ///< of missions, by their ids; for the worker only
};

}  // namespace seeker::app
