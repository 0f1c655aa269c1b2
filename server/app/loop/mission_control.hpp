/// \file
/// MissionControl starts, resumes and stops missions, and checks what must hold before one begins.
#pragma once

#include <optional>
#include <string>

#include "common/api/mission.hpp"
#include "common/core/result.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/localiser.hpp"
#include "server/app/loop/loop_hooks.hpp"
#include "server/app/loop/map_commands.hpp"
#include "server/app/loop/mission_checkpoints.hpp"
#include "server/app/loop/mission_resumption.hpp"
#include "server/app/loop/motion_control.hpp"
#include "server/app/loop/sensing.hpp"
#include "server/app/loop/situation_source.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/missions/mission_executor.hpp"

namespace seeker::app {

/// Owns the mission that was cut off and the checkpoints of the one that runs. Lives on the loop's thread.
class MissionControl {
 public:
  /// These objects must outlive MissionControl.
  struct Parties {
    MissionExecutor& executor;
    const WorldLink& world;
    const Sensing& sensing;
    const SituationSource& situation;
    Localiser& localiser;
    MapCommands& maps;
    MotionControl& motion;
    Diagnostics& diagnostics;
    const LoopHooks& hooks;
  };

  MissionControl(const RobotMapParams& params, const Parties& parties);

  /// kRefused: the emergency stop is latched, another client holds the lease, or the base cannot be driven. kNotReady:
  /// the robot's place is not known, its world is out of reach, or the disk takes nothing.
  [[nodiscard]] Result<api::MissionId> start(const api::MissionRequest& request, const std::string& client);
  /// When the command resumes a mission that a crash cut off, `client` becomes its owner.
  [[nodiscard]] Status command(api::MissionCommand command, const std::string& client);
  /// Returns whether this mission runs or is paused.
  [[nodiscard]] bool runs(const api::MissionId& mission) const {
    return parties_.executor.request() != nullptr && parties_.executor.request()->id == mission;
  }
  /// Ends a mission that has just begun, because its beginning could not be written to the disk, and disarms the robot.
  void end_unkept(const api::MissionId& mission, const Error& error);
  /// Ends the present mission and the search for the robot's place in a kept map.
  void stop();

  /// Remembers the mission that a crash cut off; `resume` starts it again unless another has been started.
  void offer_unfinished(std::optional<api::MissionRequest> request) { resumption_.offer(std::move(request)); }
  [[nodiscard]] const MissionResumption& resumption() const { return resumption_; }
  /// Returns the cut-off mission whose map must be read before it resumes; nothing when none waits or it needs no map.
  [[nodiscard]] std::optional<api::MissionId> checkpoint_to_resume() const;
  /// True while the map that the cut-off mission was building waits for `resume`.
  [[nodiscard]] bool map_waits_for_resume() const;
  /// Loads the map of the cut-off mission and looks for the robot's place in it, first where it was last; then the
  /// mission goes on. Where there is no map to load, or the robot is not found in it, a new map is begun.
  [[nodiscard]] Status resume_in_map(const Result<LineMap>& map, const MapIdentity& identity, const std::string& client,
                                     KeptState kept = {});
  /// Call it when a client has loaded another map: what was kept for the cut-off mission does not apply to it.
  void another_map_loaded() { resumption_.another_map_loaded(); }
  /// Call it once a tick: it goes on with the mission whose map was loaded, when the robot has been looked for in it.
  void resume_when_found();
  /// Returns the velocity that rotates the robot during that search; zero when another client holds the lease.
  [[nodiscard]] Twist2 search_velocity();

  /// Uses other parameters of checkpoints and of the search for the robot's place from now on.
  void use(const RobotMapParams& params) {
    resumption_.use(params);
    checkpoints_.use(params);
  }

  /// Call it once a tick: it keeps the map of the mission that runs.
  void keep_checkpoint() { checkpoints_.keep(parties_.executor, parties_.world.now()); }
  [[nodiscard]] MissionCheckpoints& checkpoints() { return checkpoints_; }
  /// Call it when the mission has ended: its checkpoints may be deleted.
  void drop_checkpoints();

 private:
  [[nodiscard]] Status may_start(const api::MissionRequest& request, const std::string& client) const;
  [[nodiscard]] Status can_be_kept() const;
  [[nodiscard]] Status able_to(const api::MissionTask& task) const;
  [[nodiscard]] Status resume_without_map(const Error& error, const KeptState& kept, const std::string& client);
  void begin_new_map();

  Parties parties_;
  MissionResumption resumption_;
  MissionCheckpoints checkpoints_;
};

}  // namespace seeker::app
