#include "common/api/fleet.hpp"

#include <algorithm>

#include "common/core/polygon.hpp"

namespace seeker::api {
namespace {

template <class T>
void keep_newest(std::vector<T>& all, std::size_t at_most) {
  if (all.size() > at_most) {
    all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(at_most));
  }
}

}  // namespace

bool in_reach(const Point2& p_map) { return p_map.cwiseAbs().maxCoeff() <= kMaxFleetReach_m; }

bool in_reach(const Detection& detection) {
  return in_reach(detection.map_T_base.translation()) && (!detection.position || in_reach(*detection.position)) &&
         detection.position_covariance.cwiseAbs().maxCoeff() <= kMaxFleetCovariance_m2;
}

RobotTopology within_limits(RobotTopology robot) {
  Topology& topology = robot.topology;
  std::vector<TopologyNode>& nodes = topology.nodes;
  std::erase_if(nodes, [](const TopologyNode& node) { return !in_reach(node.map_T_base.translation()); });
  keep_newest(nodes, kMaxFleetPlaces);
  const std::size_t share = std::max<std::size_t>(nodes.size(), 1);
  for (TopologyNode& node : nodes) {
    std::erase_if(node.goals, [&](const TopologyGoal& goal) {
      return !in_reach(goal.p_map) || (goal.p_map - node.map_T_base.translation()).norm() > kMaxFleetGoal_m;
    });
    keep_newest(node.goals, kMaxFleetGoals / share);
    keep_newest(node.sectors, kMaxFleetSectors / share);
  }
  const auto known = [&](std::uint64_t id) {
    return std::any_of(nodes.begin(), nodes.end(), [id](const TopologyNode& node) { return node.id == id; });
  };
  std::erase_if(topology.edges, [&](const TopologyEdge& edge) { return !known(edge.a) || !known(edge.b); });
  keep_newest(topology.edges, kMaxFleetTopologyEdges);
  topology.current = known(topology.current) ? topology.current : 0;
  if (robot.target_map && !in_reach(*robot.target_map)) {
    robot.target_map.reset();
  }
  return robot;
}

std::vector<OccupancyTile> within_limits(std::vector<OccupancyTile> tiles, const Point2& p_map) {
  const CellIndex here = GridFrame{Point2::Zero(), kTileSide_cells * kTileResolution_m}.cell_of(p_map);
  const auto off = [&](const OccupancyTile& tile) {
    return std::max(std::abs(tile.index.i - here.i), std::abs(tile.index.j - here.j));
  };
  std::erase_if(tiles, [&](const OccupancyTile& tile) { return off(tile) >= kMaxFleetFloorSide_tiles / 2; });
  if (tiles.size() > kMaxFleetTiles) {
    std::stable_sort(tiles.begin(), tiles.end(),
                     [&](const OccupancyTile& a, const OccupancyTile& b) { return off(a) < off(b); });
    tiles.resize(kMaxFleetTiles);
  }
  return tiles;
}

std::vector<MappedSide> within_limits(std::vector<MappedSide> sides, const Point2& p_map) {
  std::erase_if(sides, [](const MappedSide& side) { return !in_reach(side.left_map) || !in_reach(side.right_map); });
  if (sides.size() > kMaxFleetSides) {
    const auto off_m = [&](const MappedSide& side) {
      return distance_to_segment_m(side.left_map, side.right_map, p_map);
    };
    std::stable_sort(sides.begin(), sides.end(),
                     [&](const MappedSide& a, const MappedSide& b) { return off_m(a) < off_m(b); });
    sides.resize(kMaxFleetSides);
  }
  return sides;
}

std::vector<Detection> within_limits(std::vector<Detection> detections) {
  std::erase_if(detections, [](const Detection& one) { return !in_reach(one); });
  std::stable_sort(detections.begin(), detections.end(),
                   [](const Detection& a, const Detection& b) { return a.id < b.id; });
  keep_newest(detections, kMaxFleetDetections);
  return detections;
}

std::string_view to_string(FleetState state) {
  switch (state) {
    case FleetState::kWaiting: return "WAITING";
    case FleetState::kMerged: return "MERGED";
    case FleetState::kAmbiguous: return "AMBIGUOUS";
    case FleetState::kInsufficientOverlap: return "INSUFFICIENT_OVERLAP";
    case FleetState::kContradicted: return "CONTRADICTED";
    case FleetState::kSplit: return "SPLIT";
  }
  return "WAITING";
}

}  // namespace seeker::api
