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

  /// Returns whether such a mission builds a map that it needs in order to go on after a crash.
  [[nodiscard]] static bool wanted_for(const api::MissionTask& task);

  /// Uses other periods and distances from now on.
  void use(const RobotMapParams& params) { params_ = params; }
  /// Call it when a mission begins; its first checkpoint is due after the period or the distance of the parameters.
  void begin(RobotTime now);
  /// Call it once a tick: it keeps the map when that is due, and the robot's place in it more often.
  void keep(const MissionExecutor& missions, RobotTime now);
  /// Call it when a mission goes on from a checkpoint on disk.
  void adopt() { kept_ = true; }
  /// Call it when no mission needs its checkpoints any more; with `of_a_crash` those of an earlier run of the program
  /// are void, too.
  void drop(bool of_a_crash);

  /// Takes the outcome of LoopHooks::on_checkpoint.
  void written(const Status& written);
  /// Takes the outcome of LoopHooks::on_place. A place that was not kept is no loss: the next one follows soon.
  void place_written() { place_waits_ = false; }

 private:
  void keep_place(const api::MissionId& mission, const MissionExecutor& missions, RobotTime now);
  [[nodiscard]] MissionPlace place(const MissionExecutor& missions) const;

  RobotMapParams params_;
  const Localiser& localiser_;
  Diagnostics& diagnostics_;
  const LoopHooks& hooks_;
  bool kept_ = false;   ///< a checkpoint may be on disk
  bool waits_ = false;  ///< a checkpoint is being written
  std::optional<std::uint64_t> revision_;
  RobotTime at_;
  std::optional<Pose2> map_T_base_;  ///< where the robot was at the last checkpoint
  bool place_waits_ = false;         ///< a place is being written
  RobotTime place_at_;
};

}  // namespace seeker::app
