#include "server/explore/lookout.hpp"

#include "server/nav/visibility.hpp"

namespace seeker::explore {
namespace {

/// From so near one sees best whether somebody still stands in the way,
constexpr double kNear_m = 1.5;
/// and from here well enough.
constexpr double kFar_m = 3.0;
/// Whoever stands there hides the place itself.
constexpr double kBody_m = 0.4;

bool sees(const Point2& from_map, const Point2& place_map, const nav::FloorView& floor) {
  const Point2 back = from_map - place_map;
  if (back.norm() <= kBody_m) {
    return true;
  }
  const Point2 before_map = place_map + kBody_m * back.normalized();
  return nav::line_of_sight(floor.occupancy, from_map, before_map);
}

}  // namespace

std::optional<Point2> lookout_for(const Point2& place_map, const nav::FloorView& floor,
                                  const nav::DistanceField& costs) {
  const auto in_sight = [&](const Point2& p_map) { return sees(p_map, place_map, floor); };
  std::optional<CellIndex> cell;
  for (const double radius_m : {kNear_m, kFar_m}) {
    cell = cell ? cell : costs.cheapest_near(place_map, radius_m, in_sight);
  }
  cell = cell ? cell : costs.cheapest_near(place_map, kNear_m);
  return cell ? std::optional(floor.cost.frame().centre_of(*cell)) : std::nullopt;
}

}  // namespace seeker::explore
