#include "server/fleet/topology_map.hpp"
#include "server/nav/ray.hpp"

namespace seeker::fleet {
namespace {

Corridor along(const nav::CostMap& map, const Point2& from_map, const Point2& to_map, double width_m) {
  const GridFrame& frame = map.frame();
  const double half_m = 0.5 * width_m;
  Corridor seen = Corridor::kFree;
  nav::RayWalk walk((from_map - frame.origin) / frame.resolution_m, (to_map - frame.origin) / frame.resolution_m);
  do {
    const CellIndex cell = walk.cell();
    const nav::CellState state = map.state(cell);
    if (state == nav::CellState::kUnknown) {
      seen = Corridor::kUnknown;
      continue;
    }
    const Point2 p_map = frame.centre_of(cell);
    const bool at_end = (p_map - from_map).norm() < half_m || (p_map - to_map).norm() < half_m;
    // Clearances are between centres of cells.
    const bool narrow = !at_end && map.clearance_m(cell) + frame.resolution_m < half_m;
    if (state == nav::CellState::kOccupied || narrow) {
      return Corridor::kBlocked;
    }
  } while (walk.advance());
  return seen;
}

}  // namespace

CorridorTest corridors_of(const nav::CostMap& map) {
  return [&map](const Point2& from_map, const Point2& to_map, double width_m) {
    return along(map, from_map, to_map, width_m);
  };
}

}  // namespace seeker::fleet
