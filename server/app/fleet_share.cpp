// What the main robot passes on of where each robot goes (FleetLeader).

#include <utility>

#include "server/app/fleet_leader.hpp"
#include "server/fleet/topology_map.hpp"
#include "server/nav/shared_floor.hpp"

namespace seeker::app {

namespace {

/// A robot that was started anew, or is lost, knows less than it told before: what it told then counts all the same.
void hear(const std::optional<RobotTopology>& told, std::optional<RobotTopology>& kept) {
  if (told && (!told->topology.nodes.empty() || !kept)) {
    kept = told;
    return;
  }
  if (kept) {
    kept->map_T_base = told ? told->map_T_base : kept->map_T_base;
    kept->velocity = told ? told->velocity : std::nullopt;
    kept->active = false;
    kept->target_map.reset();
  }
}

}  // namespace

nav::SharedFloor floor_of(const std::vector<OccupancyTile>& tiles) {
  std::optional<Grid<std::uint8_t>> floor = assemble(tiles);
  return floor ? std::make_shared<const Grid<std::uint8_t>>(*std::move(floor)) : nullptr;
}

bool FleetLeader::silent(const std::optional<WallTime>& heard, WallTime now) const {
  return !heard || now - *heard >= params_.silence_limit;
}

Result<api::FleetShared> FleetLeader::share(const api::FleetShare& share) {
  const std::lock_guard lock(mutex_);
  const auto known = members_.find(share.robot_id);
  if (known == members_.end() || known->second.manifest.instance != share.instance) {
    return fail(Errc::kNotFound, "robot '" + share.robot_id + "' has to announce its map first");
  }
  Member& member = known->second;
  const WallTime now = std::chrono::steady_clock::now();
  member.seen = now;
  member.shared = now;
  member.manifest.map_T_base = share.topology ? std::optional(share.topology->map_T_base) : std::nullopt;
  hear(share.topology, member.topology);
  api::FleetShared shared{member.state, {}};
  if (member.state == api::FleetState::kMerged && member.main_T_map) {
    shared.others = others_of(share.robot_id, *member.main_T_map, now);
  }
  return shared;
}

/// In the frame of the robot that asks.
std::vector<RobotTopology> FleetLeader::others_of(const std::string& robot_id, const Pose2& main_T_map,
                                                  WallTime now) const {
  std::vector<RobotTopology> others;
  const Pose2 map_T_main = inverse(main_T_map);
  if (own_topology_ && robot_id != params_.robot_id) {
    others.push_back(api::within_limits(fleet::moved(*own_topology_, map_T_main)));
  }
  for (const auto& [id, member] : members_) {
    const bool merged = member.state == api::FleetState::kMerged && member.main_T_map;
    if (merged && member.topology && id != robot_id) {
      RobotTopology other = fleet::moved(*member.topology, map_T_main * *member.main_T_map);
      if (silent(member.shared, now)) {
        other.active = false;
        other.velocity.reset();
      }
      others.push_back(api::within_limits(std::move(other)));
    }
  }
  return others;
}

Result<api::FleetFloors> FleetLeader::floor(const api::FleetFloor& floor) {
  std::vector<std::pair<Pose2, nav::SharedFloor>> others;
  Point2 p_map = Point2::Zero();
  {
    const std::lock_guard lock(mutex_);
    const auto known = members_.find(floor.robot_id);
    if (known == members_.end() || known->second.manifest.instance != floor.instance) {
      return fail(Errc::kNotFound, "robot '" + floor.robot_id + "' has to announce its map first");
    }
    Member& member = known->second;
    member.seen = std::chrono::steady_clock::now();
    member.floor = floor_of(floor.tiles);
    if (member.state == api::FleetState::kMerged && member.main_T_map) {
      others = floors_of_others(floor.robot_id, *member.main_T_map);
    }
    p_map = member.manifest.map_T_base.value_or(Pose2{}).translation();
  }
  const nav::SharedFloor all = nav::carried(others);
  return api::FleetFloors{all ? api::within_limits(cut(*all), p_map) : std::vector<OccupancyTile>()};
}

/// With the poses of their frames in that of the robot that asks.
std::vector<std::pair<Pose2, nav::SharedFloor>> FleetLeader::floors_of_others(const std::string& robot_id,
                                                                              const Pose2& main_T_map) const {
  std::vector<std::pair<Pose2, nav::SharedFloor>> floors;
  const Pose2 map_T_main = inverse(main_T_map);
  if (own_floor_ && robot_id != params_.robot_id) {
    floors.emplace_back(map_T_main, own_floor_);
  }
  for (const auto& [id, member] : members_) {
    if (member.state == api::FleetState::kMerged && member.main_T_map && member.floor && id != robot_id) {
      floors.emplace_back(map_T_main * *member.main_T_map, member.floor);
    }
  }
  return floors;
}

/// Floors of buildings are large: they are looked at less often than where everybody goes.
void FleetLeader::refresh_floor() {
  const std::optional<OwnFloor> own = floor_inbox_.take();
  std::vector<std::pair<Pose2, nav::SharedFloor>> others;
  {
    const std::lock_guard lock(mutex_);
    own_floor_ = own && !remembers_own_ ? floor_of(*own) : own_floor_;
    others = remembers_own_ ? others : floors_of_others(params_.robot_id, Pose2{});
  }
  others_floor_ = nav::carried(others);
  host_.give_floor(floor_inbox_.reply());
}

void FleetLeader::refresh() {
  if (const WallTime now = std::chrono::steady_clock::now(); now >= floor_at_) {
    floor_at_ = now + params_.floor_period;
    refresh_floor();
  }
  host_.give_topology(topology_inbox_.reply());
  const std::optional<OwnTopology> own = topology_inbox_.take();
  std::vector<RobotTopology> others;
  {
    const std::lock_guard lock(mutex_);
    if (own) {
      own_map_T_base_ = *own ? std::optional((*own)->map_T_base) : std::nullopt;
      hear(remembers_own_ ? std::nullopt : *own, own_topology_);
    }
    if (!remembers_own_) {
      others = others_of(params_.robot_id, Pose2{}, std::chrono::steady_clock::now());
    }
  }
  host_.take_view(others.empty() ? std::nullopt
                                 : std::optional(FleetView{params_.robot_id, std::move(others), others_floor_}));
}

}  // namespace seeker::app
