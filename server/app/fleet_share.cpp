// What the main robot passes on of where each robot goes (FleetLeader).

#include <utility>

#include "server/app/fleet_leader.hpp"
#include "server/fleet/topology_map.hpp"

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

void FleetLeader::refresh() {
  host_.give_topology([inbox = inbox_](Result<OwnTopology> own) {
    if (own) {
      const std::lock_guard lock(inbox->mutex);
      inbox->own = std::move(*own);
    }
  });
  std::optional<OwnTopology> own;
  {
    const std::lock_guard lock(inbox_->mutex);
    own = std::exchange(inbox_->own, std::nullopt);
  }
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
                                 : std::optional(FleetView{params_.robot_id, std::move(others), nullptr}));
}

}  // namespace seeker::app
