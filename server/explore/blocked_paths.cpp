#include "server/explore/blocked_paths.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "common/core/occupancy_tile.hpp"
#include "common/core/polygon.hpp"
#include "server/nav/frontiers.hpp"

namespace seeker::explore {
namespace {

/// How far the rest of somebody reaches from a cell of his that lies on known floor.
constexpr double kBody_m = 0.45;
/// A place within this distance of reachable floor is observed from there.
constexpr double kAlmostThere_m = 0.5;
/// Floor that is cut off is identified by one of its cells, which may lie this far from that of another map.
constexpr double kSameFloor_m = 0.3;

/// What is occupied and connected to the cells that lie on known floor, as far as a body reaches, without the walls. Of
/// somebody in a door most lies beside that floor: too near to the posts for the robot.
std::set<CellIndex> body_of(const nav::StandingObject& object, const nav::CostMap& map,
                            const std::vector<MapSegment>& segments) {
  const double reach_cells = kBody_m / map.frame().resolution_m;
  std::set<CellIndex> body(object.cells.begin(), object.cells.end());
  std::vector<std::pair<CellIndex, CellIndex>> ends;  // a cell, and the one on known floor that it was reached from
  for (const CellIndex cell : object.cells) {
    ends.emplace_back(cell, cell);
  }
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const auto [cell, from] = ends[k];
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        const CellIndex next{cell.i + di, cell.j + dj};
        const bool his = map.state(next) == nav::CellState::kOccupied &&
                         std::hypot(next.i - from.i, next.j - from.j) <= reach_cells &&
                         !nav::on_wall(map.frame().centre_of(next), segments);
        if (his && body.insert(next).second) {
          ends.emplace_back(next, from);
        }
      }
    }
  }
  return body;
}

Grid<std::uint8_t> without(const std::vector<nav::StandingObject>& objects, const OpeningsInput& input) {
  Grid<std::uint8_t> occupancy = input.floor.occupancy;
  for (const nav::StandingObject& object : objects) {
    for (const CellIndex cell : body_of(object, input.floor.cost, input.segments)) {
      occupancy[cell] = 0;
    }
  }
  return occupancy;
}

/// Places that a path would lead to over `open`, and that none leads to now.
std::vector<UnreachablePlace> places_behind(const nav::FloorView& open, const nav::DistanceField& costs,
                                            const OpeningsInput& input, const ViewpointParams& params) {
  OpeningsInput then{open, costs, input.segments, input.areas, input.map_T_base, input.now, false};
  std::vector<UnreachablePlace> places;
  for (const Opening& opening : frontier_openings(then, params)) {
    if (!input.costs.cheapest_near(opening.p_map, kAlmostThere_m)) {
      places.push_back({opening.p_map, UnreachableCause::kBlocked, opening.size_m,
                        "a person or an object blocks the path to the border of unknown floor"});
    }
  }
  for (const CutOffFloor& part : cut_off_floor(input.floor.cost, input.costs, params.min_cut_off_m2)) {
    if (costs.cheapest_near(part.p_map, kSameFloor_m)) {
      places.push_back(unreachable_place(part));
    }
  }
  return places;
}

bool near_path(const Point2& p_map, const nav::Path& path, double near_m) {
  for (std::size_t k = 1; k < path.waypoints.size(); ++k) {
    if (distance_to_segment_m(path.waypoints[k - 1], path.waypoints[k], p_map) < near_m) {
      return true;
    }
  }
  return false;
}

bool on_any_path(const nav::StandingObject& object, const std::vector<nav::Path>& paths, const nav::CostMap& map) {
  const double near_m = map.params().robot_radius_m + map.frame().resolution_m;
  return std::any_of(object.cells.begin(), object.cells.end(), [&](CellIndex cell) {
    return std::any_of(paths.begin(), paths.end(),
                       [&](const nav::Path& path) { return near_path(map.frame().centre_of(cell), path, near_m); });
  });
}

}  // namespace

BlockedPaths blocked_paths(const OpeningsInput& input, const nav::KnownFloor& known,
                           const std::vector<Point2>& obstacles_map, const ViewpointParams& params) {
  const nav::CostMap& present = input.floor.cost;
  std::vector<nav::StandingObject> objects = known.occupied_now(input.floor, input.segments);
  Grid<std::uint8_t> occupancy = without(objects, input);
  for (const Point2& p_map : obstacles_map) {
    objects.push_back({p_map, {present.frame().cell_of(p_map)}});
  }
  if (objects.empty()) {
    return {};
  }
  nav::CostMapLimits limits;
  limits.bound = input.areas.bound;
  limits.keep_out = input.areas.keep_out;
  auto cost = nav::CostMap::build(occupancy, present.params(), limits);
  if (!cost) {
    return {};
  }
  const auto costs = nav::DistanceField::build(*cost, input.map_T_base.translation());
  if (!costs) {
    return {};
  }
  const nav::FloorView open{std::move(occupancy), std::move(*cost), input.floor.reachable, input.floor.revision,
                            input.floor.built};
  BlockedPaths blocked;
  blocked.behind_map = places_behind(open, *costs, input, params);
  std::vector<nav::Path> paths;
  for (const UnreachablePlace& place : blocked.behind_map) {
    if (auto path = costs->path_to(open.cost, place.p_map)) {
      paths.push_back(std::move(*path));
    }
  }
  for (const nav::StandingObject& object : objects) {
    if (on_any_path(object, paths, present)) {
      blocked.at_map.push_back(object.p_map);
    }
  }
  return blocked;
}

}  // namespace seeker::explore
