// What the main robot passes on of where each robot goes (FleetLeader).

#include <algorithm>
#include <utility>

#include "server/app/fleet/fleet_leader.hpp"
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

SharedSearch shared_search(std::vector<SearchedFloor> searched, const SharedSearch& before) {
  if (searched.empty() || (before && *before == searched)) {
    return searched.empty() ? nullptr : before;
  }
  return std::make_shared<const std::vector<SearchedFloor>>(std::move(searched));
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
  hear(share.topology, member.told.topology);
  api::FleetShared shared{member.state, {}};
  if (member.state == api::FleetState::kMerged && member.main_T_map) {
    shared.others = others_of(share.robot_id, *member.main_T_map, now);
  }
  return shared;
}

/// The robots that are merged, the asker apart.
std::vector<FleetLeader::Other> FleetLeader::others_than(const std::string& robot_id, const Pose2& main_T_map) const {
  std::vector<Other> others;
  const Pose2 map_T_main = inverse(main_T_map);
  if (robot_id != params_.robot_id) {
    others.push_back({params_.robot_id, own_told_, map_T_main, nullptr});
  }
  for (const auto& [id, member] : members_) {
    if (member.state == api::FleetState::kMerged && member.main_T_map && id != robot_id) {
      others.push_back({id, member.told, map_T_main * *member.main_T_map, &member});
    }
  }
  return others;
}

std::vector<RobotTopology> FleetLeader::others_of(const std::string& robot_id, const Pose2& main_T_map,
                                                  WallTime now) const {
  std::vector<RobotTopology> topologies;
  for (const Other& other : others_than(robot_id, main_T_map)) {
    if (!other.told.topology) {
      continue;
    }
    RobotTopology topology = fleet::moved(*other.told.topology, other.map_T_theirs);
    if (other.member != nullptr && silent(other.member->shared, now)) {
      topology.active = false;
      topology.velocity.reset();
    }
    if (api::in_reach(topology.map_T_base.translation())) {  // else whoever is told would refuse all of them
      topologies.push_back(api::within_limits(std::move(topology)));
    }
  }
  return topologies;
}

std::vector<api::Detection> FleetLeader::Finds::all() const {
  std::vector<api::Detection> all = now;
  for (const api::Detection& earlier : before) {
    if (std::none_of(now.begin(), now.end(), [&](const api::Detection& one) { return one.id == earlier.id; })) {
      all.push_back(earlier);
    }
  }
  return api::within_limits(std::move(all));
}

void FleetLeader::DatedSearch::hear(std::optional<SearchedFloor> told, WallTime now) {
  if (told && told != floor) {
    floor = std::move(told);
    changed = now;
  }
}

/// A full queue only delays it: it is written with the next map that is looked at, too.
void FleetLeader::ask_for_record(const std::string& robot_id, Member& member) {
  if (!member.record_waits) {
    member.record_waits = worker_
                              .post([this, robot_id] {
                                {
                                  const std::lock_guard lock(mutex_);
                                  members_.at(robot_id).record_waits = false;
                                }
                                keep_record(robot_id);
                              })
                              .has_value();
  }
}

Result<api::FleetSightings> FleetLeader::seen(const api::FleetSeen& seen) {
  api::FleetSightings sightings;
  std::vector<std::pair<Pose2, nav::SharedFloor>> others;
  Point2 p_map = Point2::Zero();
  {
    const std::lock_guard lock(mutex_);
    const auto known = members_.find(seen.robot_id);
    if (known == members_.end() || known->second.manifest.instance != seen.instance) {
      return fail(Errc::kNotFound, "robot '" + seen.robot_id + "' has to announce its map first");
    }
    Member& member = known->second;
    const WallTime now = std::chrono::steady_clock::now();
    member.seen = now;
    if (seen.placed) {
      hear_seen(member, seen, now);
    }
    if (member.state == api::FleetState::kMerged && member.main_T_map) {
      others = floors_of_others(seen.robot_id, *member.main_T_map);
      sightings.findings = findings_of_others(seen.robot_id, *member.main_T_map);
      sightings.searched = searched_by_others(seen.robot_id, *member.main_T_map, now);
    }
    p_map = member.manifest.map_T_base.value_or(Pose2{}).translation();
  }
  const nav::SharedFloor all = nav::carried(others);
  sightings.floor = all ? api::within_limits(cut(*all), p_map) : std::vector<OccupancyTile>();
  return sightings;
}

void FleetLeader::hear_seen(Member& member, const api::FleetSeen& seen, WallTime now) {
  member.told.floor = floor_of(seen.tiles);
  member.told.search.hear(seen.searched, now);
  if (member.told.finds.now != seen.detections) {
    member.told.finds.now = seen.detections;
    ask_for_record(seen.robot_id, member);
  }
}

/// With the poses of their frames in that of the robot that asks.
std::vector<std::pair<Pose2, nav::SharedFloor>> FleetLeader::floors_of_others(const std::string& robot_id,
                                                                              const Pose2& main_T_map) const {
  std::vector<std::pair<Pose2, nav::SharedFloor>> floors;
  for (const Other& other : others_than(robot_id, main_T_map)) {
    if (other.told.floor) {
      floors.emplace_back(other.map_T_theirs, other.told.floor);
    }
  }
  return floors;
}

std::vector<api::FleetFinding> FleetLeader::findings_of_others(const std::string& robot_id,
                                                               const Pose2& main_T_map) const {
  std::vector<api::FleetFinding> findings;
  for (const Other& other : others_than(robot_id, main_T_map)) {
    for (api::Detection& one : carried(other.told.finds.all(), other.map_T_theirs)) {
      findings.push_back({other.robot_id, std::move(one)});
    }
  }
  return findings;
}

/// What is old proves nothing any more: things and people move.
std::vector<SearchedFloor> FleetLeader::searched_by_others(const std::string& robot_id, const Pose2& main_T_map,
                                                           WallTime now) const {
  std::vector<SearchedFloor> all;
  for (const Other& other : others_than(robot_id, main_T_map)) {
    const DatedSearch& search = other.told.search;
    if (!search.floor || now - search.changed >= params_.search_age) {
      continue;
    }
    const Pose2 map_T_grid = other.map_T_theirs * search.floor->map_T_grid;
    if (api::in_reach(map_T_grid.translation())) {
      all.push_back({search.floor->targets, map_T_grid, search.floor->probability});
    }
  }
  return all;
}

/// Whether it has found something else than it told before.
bool FleetLeader::take_own_seen(const OwnSeen& own) {
  if (!own.placed || remembers_own_) {
    return false;
  }
  own_told_.floor = floor_of(own.floor);
  own_told_.search.hear(own.searched, std::chrono::steady_clock::now());
  if (!own.searched) {
    own_told_.search = {};  // its program is this one: it has forgotten nothing, but is in another map
  }
  if (own_told_.finds.now == own.detections) {
    return false;
  }
  own_told_.finds.now = own.detections;
  return true;
}

/// Floors of buildings are large: they are looked at less often than where everybody goes.
void FleetLeader::refresh_seen() {
  const std::optional<OwnSeen> own = seen_inbox_.take();
  std::vector<std::pair<Pose2, nav::SharedFloor>> others;
  std::vector<api::FleetFinding> findings;
  std::vector<SearchedFloor> searched;
  bool found_more = false;
  {
    const std::lock_guard lock(mutex_);
    found_more = own && take_own_seen(*own);
    if (!remembers_own_) {
      others = floors_of_others(params_.robot_id, Pose2{});
      findings = findings_of_others(params_.robot_id, Pose2{});
      searched = searched_by_others(params_.robot_id, Pose2{}, std::chrono::steady_clock::now());
    }
  }
  if (found_more) {
    // A full queue only delays it: it is written with the next map that is looked at, too.
    static_cast<void>(worker_.post([this] { keep_memory(); }));
  }
  others_floor_ = nav::carried(others);
  others_searched_ = shared_search(std::move(searched), others_searched_);
  news_.tell(findings, host_);
  host_.give_seen(seen_inbox_.reply());
}

void FleetLeader::refresh() {
  if (const WallTime now = std::chrono::steady_clock::now(); now >= floor_at_) {
    floor_at_ = now + params_.floor_period;
    refresh_seen();
  }
  host_.give_topology(topology_inbox_.reply());
  const std::optional<OwnTopology> own = topology_inbox_.take();
  std::vector<RobotTopology> others;
  {
    const std::lock_guard lock(mutex_);
    if (own) {
      own_map_T_base_ = *own ? std::optional((*own)->map_T_base) : std::nullopt;
      hear(remembers_own_ ? std::nullopt : *own, own_told_.topology);
    }
    if (!remembers_own_) {
      others = others_of(params_.robot_id, Pose2{}, std::chrono::steady_clock::now());
    }
  }
  host_.take_view(others.empty()
                      ? std::nullopt
                      : std::optional(FleetView{params_.robot_id, std::move(others), others_floor_, others_searched_}));
}

}  // namespace seeker::app
