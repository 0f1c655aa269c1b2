#include "server/nav/lookout.hpp"

#include <algorithm>

#include "server/nav/visibility.hpp"

namespace seeker::nav {
namespace {

/// Within this distance the robot sees best whether somebody still stands on the path,
constexpr double kNear_m = 1.5;
/// and from here well enough.
constexpr double kFar_m = 3.0;
/// Whoever stands there hides the place itself.
constexpr double kBody_m = 0.4;
/// Room for a robot and a person who walks by and keeps a step away from both.
constexpr double kRoom_m = 1.5;
/// One more metre of room is worth this many metres of path length.
constexpr double kDistanceForRoom = 10.0;
/// Places farther away than this are not examined.
constexpr double kFarthest_m = 15.0;

bool sees(const Point2& from_map, const Point2& place_map, const FloorView& floor) {
  const Point2 back = from_map - place_map;
  if (back.norm() <= kBody_m) {
    return true;
  }
  const Point2 before_map = place_map + kBody_m * back.normalized();
  return line_of_sight(floor.occupancy, from_map, before_map);
}

}  // namespace

std::optional<Point2> lookout_for(const Point2& place_map, const FloorView& floor, const DistanceField& costs) {
  const auto in_sight = [&](const Point2& p_map) { return sees(p_map, place_map, floor); };
  std::optional<CellIndex> cell;
  for (const double radius_m : {kNear_m, kFar_m}) {
    cell = cell ? cell : costs.cheapest_near(place_map, radius_m, in_sight);
  }
  cell = cell ? cell : costs.cheapest_near(place_map, kNear_m);
  return cell ? std::optional(floor.cost.frame().centre_of(*cell)) : std::nullopt;
}

std::optional<Point2> place_aside(const Point2& place_map, const FloorView& floor, const DistanceField& costs) {
  std::optional<Point2> best;
  double best_m = 0.0;
  for (std::size_t k = 0; k < costs.costs().cells().size(); ++k) {
    const CellIndex cell = costs.costs().cell(k);
    const auto cost = costs.cost_to(cell);
    const Point2 p_map = floor.cost.frame().centre_of(cell);
    if (!cost || *cost > kFarthest_m || (p_map - place_map).norm() < kRoom_m) {
      continue;
    }
    const double room_m = std::min<double>(floor.cost.clearance_m(cell), kRoom_m);
    const double worth_m = kDistanceForRoom * room_m - *cost;
    if (!best || worth_m > best_m) {
      best = p_map;
      best_m = worth_m;
    }
  }
  return best;
}

}  // namespace seeker::nav
