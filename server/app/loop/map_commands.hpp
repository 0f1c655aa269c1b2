/// \file
/// MapCommands saves or replaces the map in use, and looks for the robot's place in it.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/localiser.hpp"
#include "server/app/loop/motion_control.hpp"
#include "server/app/loop/neighbours.hpp"
#include "server/app/loop/sensing.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/missions/mission_executor.hpp"

namespace seeker::app {

/// Owns no state. It makes all that remember places forget them when the map is replaced. Lives on the loop's thread.
class MapCommands {
 public:
  /// These objects hold places or decide whether the map may change; they must outlive MapCommands.
  struct Parties {
    WorldLink& world;
    const Sensing& sensing;
    const MotionControl& motion;
    Localiser& localiser;
    Neighbours& neighbours;
    MissionExecutor& missions;
    Diagnostics& diagnostics;
  };

  /// `forget_places` is LoopParts::forget_places and may be empty.
  MapCommands(const Parties& parties, std::function<void()> forget_places);

  /// Returns the present map, to be saved under `name`.
  [[nodiscard]] Result<LoopMap> to_save(const std::string& name) const;
  /// Returns kRefused when the robot only localises in the map `name`, whose file must not change.
  [[nodiscard]] Status not_in_use(const std::string& name) const;
  /// The map was saved: from now on it is the map of that name.
  void saved(const MapIdentity& identity);

  /// Returns kBusy during a mission, kNotReady while the world is out of reach, kRefused while the robot moves.
  [[nodiscard]] Status may_change() const;
  /// Replaces the map if may_change() allows it; the robot then looks for its place in it.
  [[nodiscard]] Status load(const LineMap& map, const MapIdentity& identity);
  /// Replaces the map without asking may_change(), so that the robot may still roll.
  [[nodiscard]] Status replace(const LineMap& map, const MapIdentity& identity);
  /// Looks for the robot's place, near a pose or everywhere.
  [[nodiscard]] Status relocalise(const std::optional<Pose2>& map_T_base);
  /// Forgets the map; a new one begins where the robot is.
  void begin_new_map();
  /// Another estimator has taken over, with a map of its own or none: the places in the map before are forgotten.
  void map_exchanged() { forget_places(); }

 private:
  void forget_places();

  Parties parties_;
  std::function<void()> forget_places_;
};

}  // namespace seeker::app
