#include "server/app/fleet/other_robot.hpp"

#include <algorithm>
#include <iterator>

#include "server/fleet/topology_map.hpp"

namespace seeker::app {

std::vector<RobotTopology> topologies_of(const std::vector<OtherRobot>& others) {
  std::vector<RobotTopology> topologies;
  topologies.reserve(others.size());
  for (const OtherRobot& other : others) {
    if (!other.report.topology) {
      continue;
    }
    RobotTopology topology = fleet::moved(*other.report.topology, other.map_T_theirs);
    if (other.silent) {
      topology.active = false;
      topology.velocity.reset();
    }
    if (api::in_reach(topology.map_T_base.translation())) {
      topologies.push_back(api::within_limits(std::move(topology)));
    }
  }
  return topologies;
}

std::vector<std::pair<Pose2, nav::SharedFloor>> floors_of(const std::vector<OtherRobot>& others) {
  std::vector<std::pair<Pose2, nav::SharedFloor>> floors;
  floors.reserve(others.size());
  for (const OtherRobot& other : others) {
    if (other.report.floor) {
      floors.emplace_back(other.map_T_theirs, other.report.floor);
    }
  }
  return floors;
}

std::vector<MappedSide> sides_by(const std::vector<OtherRobot>& others) {
  std::vector<MappedSide> all;
  for (const OtherRobot& other : others) {
    if (other.report.sides) {
      const std::vector<MappedSide> theirs = moved(*other.report.sides, other.map_T_theirs);
      std::copy_if(theirs.begin(), theirs.end(), std::back_inserter(all), [](const MappedSide& side) {
        return api::in_reach(side.left_map) && api::in_reach(side.right_map);
      });
    }
  }
  return all;
}

std::vector<api::FleetFinding> findings_of(const std::vector<OtherRobot>& others) {
  std::vector<api::FleetFinding> findings;
  for (const OtherRobot& other : others) {
    for (api::Detection& one : other.report.finds_in(other.map_T_theirs)) {
      findings.push_back({other.robot_id, std::move(one)});
    }
  }
  return findings;
}

std::vector<SearchedFloor> searched_by(const std::vector<OtherRobot>& others, WallTime now, Duration max_age) {
  std::vector<SearchedFloor> all;
  all.reserve(others.size());
  for (const OtherRobot& other : others) {
    const RobotReport::Search& search = other.report.search;
    if (!search.floor || now - search.changed >= max_age) {
      continue;
    }
    const Pose2 map_T_grid = other.map_T_theirs * search.floor->map_T_grid;
    if (api::in_reach(map_T_grid.translation())) {
      all.push_back({search.floor->targets, map_T_grid, search.floor->probability});
    }
  }
  return all;
}

}  // namespace seeker::app
