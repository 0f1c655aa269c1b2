/// \file
/// Starting, resuming and stopping missions, with everything that must hold before one may begin.
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

/// Owner of the mission that was cut off and of the checkpoints of the one that runs. Lives on the loop's thread.
class MissionControl {
 public:
  /// All outlive the control.
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

  /// kRefused: stopped or in other hands; kNotReady: the robot does not know where it is, or cannot do this.
  [[nodiscard]] Result<api::MissionId> start(const api::MissionRequest& request, const std::string& client);
  /// `client` becomes the owner of a mission that it has go on after a crash.
  [[nodiscard]] Status command(api::MissionCommand command, const std::string& client);
  void stop();

  /// The mission that a crash cut off: `resume` starts it again while no other has been started.
  void offer_unfinished(std::optional<api::MissionRequest> request) { resumption_.offer(std::move(request)); }
  [[nodiscard]] const MissionResumption& resumption() const { return resumption_; }
  /// The cut-off mission whose map may be there; nothing when there is none to resume or it needs no map.
  [[nodiscard]] std::optional<api::MissionId> checkpoint_to_resume() const;
  /// The present map is not the robot's own yet: the one that its mission was building waits for `resume`.
  [[nodiscard]] bool map_waits_for_resume() const;
  /// Loads the map of the cut-off mission and looks for the robot's place in it, first where it was last; then the
  /// mission goes on. Where there is no map to load, or the robot is not found in it, a new map is begun.
  [[nodiscard]] Status resume_in_map(const Result<LineMap>& map, const MapIdentity& identity, const std::string& client,
                                     KeptState kept = {});
  /// A mission that was cut off does not go on in the map that was loaded now.
  void another_map_loaded() { resumption_.another_map_loaded(); }
  /// Once a tick: goes on with the mission whose map was loaded, when the robot has been looked for in it.
  void resume_when_found();
  /// What the robot drives while it is looked for, and nobody else drives it.
  [[nodiscard]] Twist2 search_velocity();

  /// Once a tick: keeps the map of the mission that runs.
  void keep_checkpoint() { checkpoints_.keep(parties_.executor, parties_.world.now()); }
  [[nodiscard]] MissionCheckpoints& checkpoints() { return checkpoints_; }
  /// The mission has ended: nothing needs its checkpoint any more.
  void drop_checkpoints();

 private:
  [[nodiscard]] Status may_start(const api::MissionRequest& request, const std::string& client) const;
  [[nodiscard]] Status able_to(const api::MissionTask& task) const;
  [[nodiscard]] Status resume_without_map(const Error& error, const KeptState& kept, const std::string& client);
  void begin_map_anew();

  Parties parties_;
  MissionResumption resumption_;
  MissionCheckpoints checkpoints_;
};

}  // namespace seeker::app
