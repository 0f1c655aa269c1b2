#include "server/app/loop/map_commands.hpp"

#include <utility>

namespace seeker::app {

MapCommands::MapCommands(const Parties& parties, std::function<void()> forget_places)
    : parties_(parties), forget_places_(std::move(forget_places)) {}

Status MapCommands::may_change() const {
  if (parties_.missions.present()) {
    return fail(Errc::kBusy, "a mission is running or paused; stop it first, its places belong to the present map");
  }
  if (const Status able = parties_.world.within_reach(); !able) {
    return able;  // no scan would come to find the robot's place by
  }
  // A recording that moves cannot be told to stop.
  if (parties_.sensing.moving() && parties_.motion.drivable()) {
    return fail(Errc::kRefused, "the robot moves; stop it first ('seeker stop')");
  }
  return {};
}

Result<LoopMap> MapCommands::to_save(const std::string& name) const {
  Result<LineMap> map = parties_.localiser.map().map();
  if (!map) {
    return tl::unexpected<Error>(map.error());
  }
  if (const Status free = not_in_use(name); !free) {
    return tl::unexpected<Error>(free.error());
  }
  return LoopMap{std::move(*map), parties_.localiser.map().identity()};
}

Status MapCommands::not_in_use(const std::string& name) const {
  const MapIdentity& identity = parties_.localiser.map().identity();
  if (identity.use == api::MapUse::kLocalise && identity.name == name) {
    return fail(Errc::kRefused, "the robot localises in map '" + name +
                                    "' and leaves it as it is; take another name, or load it without --localise");
  }
  return {};
}

void MapCommands::saved(const MapIdentity& identity) {
  // A copy of a map that is only localised in does not become the map in use.
  if (parties_.localiser.map().identity().use == api::MapUse::kContinue) {
    parties_.localiser.map().set_identity(identity);
  }
  parties_.diagnostics.log("map-saved", "the map was saved as '" + identity.name + "'");
}

Status MapCommands::load(const LineMap& map, const MapIdentity& identity) {
  if (Status ok = may_change(); !ok) {
    return ok;
  }
  if (Status ok = replace(map, identity); !ok) {
    return ok;
  }
  parties_.diagnostics.log("map-loaded", "map '" + identity.name + "' is loaded to " +
                                             std::string(api::to_string(identity.use)) +
                                             "; the robot looks for its place in it");
  return {};
}

Status MapCommands::replace(const LineMap& map, const MapIdentity& identity) {
  if (Status ok = parties_.localiser.map().load(map, identity, parties_.world.now()); !ok) {
    return ok;
  }
  forget_places();
  return {};
}

void MapCommands::begin_new_map() {
  parties_.localiser.map().begin_new_map();
  forget_places();
}

/// All of these are places in the map before.
void MapCommands::forget_places() {
  parties_.neighbours.forget_places();
  parties_.missions.findings().forget_places();
  if (forget_places_) {
    forget_places_();
  }
  parties_.localiser.forget_places(parties_.world.now());
}

Status MapCommands::relocalise(const std::optional<Pose2>& map_T_base) {
  if (map_T_base && !is_finite(*map_T_base)) {
    return fail(Errc::kInvalidArgument, "the pose to look near is not a finite number");
  }
  if (Status ok = may_change(); !ok) {
    return ok;
  }
  const RobotTime now = parties_.world.now();
  if (Status ok = parties_.localiser.map().relocalise(map_T_base, now); !ok) {
    return ok;
  }
  parties_.localiser.take_estimate(now);
  parties_.diagnostics.log("relocalise", "the robot looks for its place in the map");
  return {};
}

}  // namespace seeker::app
