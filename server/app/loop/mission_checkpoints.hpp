/// \file
/// The map of a mission that builds one is kept on disk while the mission runs, so that it outlives a crash.
#pragma once

#include <cstdint>
#include <optional>

#include "common/api/mission.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/time.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/localiser.hpp"
#include "server/app/loop/loop_hooks.hpp"
#include "server/app/missions/mission_executor.hpp"

namespace seeker::app {

/// Decides when a checkpoint is due and hands it to LoopHooks, which write it in the background: one at a time. Lives
/// on the loop's thread.
class MissionCheckpoints {
 public:
  /// The references outlive it.
  MissionCheckpoints(const RobotMapParams& params, const Localiser& localiser, Diagnostics& diagnostics,
                     const LoopHooks& hooks);

  /// Whether a mission of this kind builds the map that it needs to go on.
  [[nodiscard]] static bool wanted_for(const api::MissionTask& task);

  /// A mission begins: its first checkpoint is due a period or a distance from here.
  void begin(RobotTime now);
  /// Once a tick: keeps the map when that is due, and the robot's place in it more often.
  void keep(const MissionExecutor& missions, RobotTime now);
  /// There is one on disk that a mission goes on from.
  void adopt() { kept_ = true; }
  /// No mission needs them any more. `of_a_crash`: those of an earlier run of the program are void, too.
  void drop(bool of_a_crash);

  /// The answer to LoopHooks::on_checkpoint.
  void written(const Status& written);
  /// The answer to LoopHooks::on_place. A place that was not kept is no loss: the next one follows soon.
  void place_written() { place_waits_ = false; }

 private:
  void keep_place(const api::MissionId& mission, const MissionExecutor& missions, RobotTime now);
  [[nodiscard]] MissionPlace place(const MissionExecutor& missions) const;

  RobotMapParams params_;
  const Localiser& localiser_;
  Diagnostics& diagnostics_;
  const LoopHooks& hooks_;
  bool kept_ = false;   ///< there may be one on disk
  bool waits_ = false;  ///< one is being written
  std::optional<std::uint64_t> revision_;
  RobotTime at_;
  std::optional<Pose2> map_T_base_;  ///< where the robot was then
  bool place_waits_ = false;         ///< one is being written
  RobotTime place_at_;
};

}  // namespace seeker::app
