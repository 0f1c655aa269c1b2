#include "server/explore/blocked_ways.hpp"

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
/// A place so near to where the robot can go now is looked at from there.
constexpr double kAlmostThere_m = 0.5;
/// Floor that is cut off is told by a cell of it, which may lie beside that of another map by so much.
constexpr double kSameFloor_m = 0.3;

/// What is occupied and connected to the cells that lie on known floor, as far as a body reaches, without the walls. Of
/// somebody in a door most lies beside that floor: too near to the posts for the robot.
std::set<CellIndex> body_of(const nav::StandingThing& thing, const nav::CostMap& map,
                            const std::vector<MapSegment>& segments) {
  const double reach_cells = kBody_m / map.frame().resolution_m;
  std::set<CellIndex> body(thing.cells.begin(), thing.cells.end());
  std::vector<std::pair<CellIndex, CellIndex>> ends;  // a cell, and the one on known floor that it was reached from
  for (const CellIndex cell : thing.cells) {
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

Grid<std::uint8_t> without(const std::vector<nav::StandingThing>& things, const OpeningsInput& input) {
  Grid<std::uint8_t> occupancy = input.floor.occupancy;
  for (const nav::StandingThing& thing : things) {
    for (const CellIndex cell : body_of(thing, input.floor.cost, input.segments)) {
      occupancy[cell] = 0;
    }
  }
  return occupancy;
}

/// Where a way would lead to over `open`, and none does now.
std::vector<Point2> places_behind(const nav::FloorView& open, const nav::DistanceField& ways,
                                  const OpeningsInput& input, const ViewpointParams& params) {
  OpeningsInput then{open, ways, input.segments, input.areas, input.map_T_base, input.now, false};
  std::vector<Point2> places;
  for (const Opening& opening : frontier_openings(then, params)) {
    if (!input.costs.cheapest_near(opening.p_map, kAlmostThere_m)) {
      places.push_back(opening.p_map);
    }
  }
  for (const CutOffFloor& part : cut_off_floor(input.floor.cost, input.costs, params.min_cut_off_m2)) {
    if (ways.cheapest_near(part.p_map, kSameFloor_m)) {
      places.push_back(part.p_map);
    }
  }
  return places;
}

bool on_the_way(const Point2& p_map, const nav::Path& path, double near_m) {
  for (std::size_t k = 1; k < path.waypoints.size(); ++k) {
    if (distance_to_segment_m(path.waypoints[k - 1], path.waypoints[k], p_map) < near_m) {
      return true;
    }
  }
  return false;
}

bool on_a_way(const nav::StandingThing& thing, const std::vector<nav::Path>& paths, const nav::CostMap& map) {
  const double near_m = map.params().robot_radius_m + map.frame().resolution_m;
  return std::any_of(thing.cells.begin(), thing.cells.end(), [&](CellIndex cell) {
    return std::any_of(paths.begin(), paths.end(),
                       [&](const nav::Path& path) { return on_the_way(map.frame().centre_of(cell), path, near_m); });
  });
}

}  // namespace

BlockedWays blocked_ways(const OpeningsInput& input, const nav::KnownFloor& known,
                         const std::vector<Point2>& obstacles_map, const ViewpointParams& params) {
  const nav::CostMap& present = input.floor.cost;
  std::vector<nav::StandingThing> things = known.occupied_now(input.floor, input.segments);
  Grid<std::uint8_t> occupancy = without(things, input);
  for (const Point2& p_map : obstacles_map) {
    things.push_back({p_map, {present.frame().cell_of(p_map)}});
  }
  if (things.empty()) {
    return {};
  }
  nav::CostMapLimits limits;
  limits.bound = input.areas.bound;
  limits.keep_out = input.areas.keep_out;
  auto cost = nav::CostMap::build(occupancy, present.params(), limits);
  if (!cost) {
    return {};
  }
  const auto ways = nav::DistanceField::build(*cost, input.map_T_base.translation());
  if (!ways) {
    return {};
  }
  const nav::FloorView open{std::move(occupancy), std::move(*cost), input.floor.reachable, input.floor.revision,
                            input.floor.built};
  BlockedWays blocked;
  blocked.behind_map = places_behind(open, *ways, input, params);
  std::vector<nav::Path> paths;
  for (const Point2& p_map : blocked.behind_map) {
    if (auto path = ways->path_to(open.cost, p_map)) {
      paths.push_back(std::move(*path));
    }
  }
  for (const nav::StandingThing& thing : things) {
    if (on_a_way(thing, paths, present)) {
      blocked.at_map.push_back(thing.p_map);
    }
  }
  return blocked;
}

}  // namespace seeker::explore
