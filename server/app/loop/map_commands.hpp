/// \file
/// What may be done with the map in use from outside: saved, replaced by another, or searched for the robot's place.
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

/// Owns nothing but the rule that whoever holds places forgets them when another map takes the present one's place.
/// Lives on the loop's thread.
class MapCommands {
 public:
  /// Who holds places, or decides whether the map may change. All outlive the commands.
  struct Parties {
    WorldLink& world;
    const Sensing& sensing;
    const MotionControl& motion;
    Localiser& localiser;
    Neighbours& neighbours;
    MissionExecutor& missions;
    Diagnostics& diagnostics;
  };

  /// `forget_places` may be empty: LoopParts::forget_places.
  MapCommands(const Parties& parties, std::function<void()> forget_places);

  /// The present map, to be saved under a name.
  [[nodiscard]] Result<LoopMap> to_save(const std::string& name) const;
  /// kRefused when the robot localises in the map of this name: its file stays as it is.
  [[nodiscard]] Status not_in_use(const std::string& name) const;
  void saved(const MapIdentity& identity);

  /// kBusy, kNotReady or kRefused while a mission, the world or a moving robot forbid it.
  [[nodiscard]] Status may_change() const;
  /// Replaces the map, where may_change(); the robot looks for its place in it.
  [[nodiscard]] Status load(const LineMap& map, const MapIdentity& identity);
  /// As load() for a robot that may still roll.
  [[nodiscard]] Status replace(const LineMap& map, const MapIdentity& identity);
  /// Looks for the robot's place, near a pose or everywhere.
  [[nodiscard]] Status relocalise(const std::optional<Pose2>& map_T_base);
  /// Forgets the map; a new one begins where the robot is.
  void begin_anew();

 private:
  void forget_places();

  Parties parties_;
  std::function<void()> forget_places_;
};

}  // namespace seeker::app
