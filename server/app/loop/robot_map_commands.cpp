// Commands of clients about the map of segments.

#include "server/app/loop/robot_loop.hpp"

namespace seeker::app {

Status RobotLoop::may_change_map() const {
  if (missions_.present()) {
    return fail(Errc::kBusy, "a mission is running or paused; stop it first, its places belong to the present map");
  }
  if (const Status able = within_reach(); !able) {
    return able;  // no scan would come to find the robot's place by
  }
  // A recording that moves cannot be told to stop.
  if (moving() && parts_.devices.base->drivable()) {
    return fail(Errc::kRefused, "the robot moves; stop it first ('seeker stop')");
  }
  return {};
}

Result<LoopMap> RobotLoop::map_to_save(const std::string& name) const {
  Result<LineMap> map = map_.map();
  if (!map) {
    return tl::unexpected<Error>(map.error());
  }
  if (const Status free = map_not_in_use(name); !free) {
    return tl::unexpected<Error>(free.error());
  }
  return LoopMap{std::move(*map), map_.identity()};
}

Status RobotLoop::map_not_in_use(const std::string& name) const {
  const MapIdentity& identity = map_.identity();
  if (identity.use == api::MapUse::kLocalise && identity.name == name) {
    return fail(Errc::kRefused, "the robot localises in map '" + name +
                                    "' and leaves it as it is; take another name, or load it without --localise");
  }
  return {};
}

void RobotLoop::map_saved(const MapIdentity& identity) {
  // A copy of a map that is only localised in does not become the map in use.
  if (map_.identity().use == api::MapUse::kContinue) {
    map_.set_identity(identity);
  }
  log("map-saved", "the map was saved as '" + identity.name + "'");
}

Status RobotLoop::load_map(const LineMap& map, const MapIdentity& identity) {
  if (Status ok = may_change_map(); !ok) {
    return ok;
  }
  if (Status ok = map_.load(map, identity, now()); !ok) {
    return ok;
  }
  forget_places();
  has_own_map_ = false;  // a mission that was cut off does not go on in this one,
  kept_ = {};            // and what is known of it belongs to its own
  log("map-loaded", "map '" + identity.name + "' is loaded to " + std::string(api::to_string(identity.use)) +
                        "; the robot looks for its place in it");
  republish_ = true;
  return {};
}

/// All of these are places in the map before.
void RobotLoop::forget_places() {
  trajectory_.clear();
  own_topology_ = {};
  fleet_.reset();
  missions_.forget_places();
  if (parts_.forget_places) {
    parts_.forget_places();
  }
  pose_ = map_.follow(parts_.estimator->estimate(), now());
}

Status RobotLoop::relocalise(const std::optional<Pose2>& map_T_base) {
  if (map_T_base && !is_finite(*map_T_base)) {
    return fail(Errc::kInvalidArgument, "the pose to look near is not a finite number");
  }
  if (Status ok = may_change_map(); !ok) {
    return ok;
  }
  if (Status ok = map_.relocalise(map_T_base, now()); !ok) {
    return ok;
  }
  pose_ = map_.follow(parts_.estimator->estimate(), now());
  log("relocalise", "the robot looks for its place in the map");
  return {};
}

/// An epoch rises when a loop moves the map, and when a robot that was looked for is found: what it has mapped
/// meanwhile is joined to the map then, and nothing else moves.
void RobotLoop::follow_map(const std::optional<Pose2>& old_map_T_base) {
  const std::uint32_t before = pose_.map_epoch;
  const bool was_placed = is_placed(pose_.quality);
  pose_ = map_.follow(parts_.estimator->estimate(), now(), old_map_T_base);
  if (pose_.map_epoch == before || !old_map_T_base) {
    return;
  }
  if (!was_placed) {
    // The pose before was in a frame of its own: it tells where the robot was looked for, not how the map has moved.
    log("robot-found", "the robot has found its place in the map, which stays where it was");
    missions_.map_moved({.move = {}, .from_epoch = before, .to_epoch = pose_.map_epoch}, now());
    return;
  }
  const Pose2 new_T_old = pose_.map_T_base * inverse(*old_map_T_base);
  const int moved_mm = static_cast<int>(1e3 * distance_m(*old_map_T_base, pose_.map_T_base));
  log("map-moved", "the map was corrected; the robot's place in it moved by " + std::to_string(moved_mm) + " mm");
  missions_.map_moved({.move = map_.last_move(), .from_epoch = before, .to_epoch = pose_.map_epoch}, now());
  move_fleet(new_T_old);
}

}  // namespace seeker::app
