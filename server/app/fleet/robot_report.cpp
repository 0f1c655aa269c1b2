#include "server/app/fleet/robot_report.hpp"

#include <algorithm>
#include <utility>

#include "server/app/fleet/own_map.hpp"

namespace seeker::app {

std::vector<api::Detection> RobotReport::Finds::all() const {
  std::vector<api::Detection> all = now;
  for (const api::Detection& earlier : before) {
    if (std::none_of(now.begin(), now.end(), [&](const api::Detection& one) { return one.id == earlier.id; })) {
      all.push_back(earlier);
    }
  }
  return api::within_limits(std::move(all));
}

void RobotReport::Search::receive(std::optional<SearchedFloor> reported, WallTime received_at) {
  if (reported && reported != floor) {
    floor = std::move(reported);
    changed = received_at;
  }
}

void RobotReport::receive_topology(const std::optional<RobotTopology>& reported) {
  if (reported && (!reported->topology.nodes.empty() || !topology)) {
    topology = reported;
    return;
  }
  if (topology) {
    topology->map_T_base = reported ? reported->map_T_base : topology->map_T_base;
    topology->velocity = reported ? reported->velocity : std::nullopt;
    topology->active = false;
    topology->target_map.reset();
  }
}

bool RobotReport::receive_seen(const std::vector<OccupancyTile>& tiles, std::vector<MappedSide> seen_sides,
                               const std::vector<api::Detection>& detections,
                               const std::optional<SearchedFloor>& searched, WallTime received_at) {
  floor = floor_of(tiles);
  sides = shared_list(std::move(seen_sides), sides);
  search.receive(searched, received_at);
  if (finds.now == detections) {
    return false;
  }
  finds.now = detections;
  return true;
}

std::vector<api::Detection> RobotReport::finds_in(const Pose2& other_T_map) const {
  std::vector<api::Detection> found = finds.all();
  for (api::Detection& one : found) {
    one = api::moved(std::move(one), other_T_map);
  }
  std::erase_if(found, [](const api::Detection& one) { return !api::in_reach(one); });
  return found;
}

}  // namespace seeker::app
