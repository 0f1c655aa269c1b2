#include "server/explore/known_floor.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/occupancy_tile.hpp"
#include "common/core/polygon.hpp"

namespace seeker::explore {
namespace {

/// Occupied cells so near to each other are one thing; fewer cells are noise.
constexpr double kSameThing_m = 1.0;
constexpr int kThingCells = 3;
/// Cells so near to a mapped wall are the wall's; shorter segments may be what stands there.
constexpr double kWallBand_m = 0.2;
constexpr double kShortestWall_m = 0.5;

/// A grid as fine as `like` that covers both, all zero.
Grid<std::uint8_t> covering(const Grid<std::uint8_t>& a, const Grid<std::uint8_t>& like) {
  const double cell_m = like.frame().resolution_m;
  Point2 low = like.frame().origin;
  Point2 high = low + cell_m * Point2(like.width(), like.height());
  if (!a.empty()) {
    low = low.cwiseMin(a.frame().origin);
    high = high.cwiseMax(a.frame().origin + cell_m * Point2(a.width(), a.height()));
  }
  const Point2 size = (high - low) / cell_m;
  return {GridFrame{low, cell_m}, static_cast<int>(std::lround(size.x())), static_cast<int>(std::lround(size.y())), 0};
}

template <class Wanted>
void copy_into(Grid<std::uint8_t>& to, const Grid<std::uint8_t>& from, Wanted&& wanted) {
  for (std::size_t k = 0; k < from.cells().size(); ++k) {
    const Point2 p = from.frame().centre_of(from.cell(k));
    if (from.cells()[k] != 0 && wanted(p)) {
      to[to.frame().cell_of(p)] = 1;
    }
  }
}

bool on_wall(const Point2& p_map, const std::vector<MapSegment>& segments) {
  return std::any_of(segments.begin(), segments.end(), [&](const MapSegment& segment) {
    return segment.length_m >= kShortestWall_m &&
           distance_to_segment_m(segment.left(), segment.right(), p_map) < kWallBand_m;
  });
}

}  // namespace

bool seen_by_itself(const nav::FloorView& view, const Point2& p_map) {
  if (!view.own) {
    return true;
  }
  const Grid<std::uint8_t>& own = view.own->occupancy;
  const CellIndex cell = own.frame().cell_of(p_map);
  return own.contains(cell) && own[cell] != kUnknownCell;
}

void KnownFloor::add(const nav::FloorView& view, const Point2& robot_map, double near_m) {
  const Grid<std::uint8_t>& reachable = view.own ? view.own->reachable : view.reachable;
  if (reachable.cells().empty()) {
    return;
  }
  Grid<std::uint8_t> both = covering(floor_, reachable);
  copy_into(both, floor_, [](const Point2&) { return true; });
  copy_into(both, reachable, [&](const Point2& p) { return (p - robot_map).squaredNorm() <= near_m * near_m; });
  floor_ = std::move(both);
  const double cell_m = reachable.frame().resolution_m;
  present_m2_ = cell_m * cell_m *
                static_cast<double>(std::count_if(reachable.cells().begin(), reachable.cells().end(),
                                                  [](std::uint8_t cell) { return cell != 0; }));
}

bool KnownFloor::contains(const Point2& p_map) const {
  const CellIndex cell = floor_.frame().cell_of(p_map);
  return floor_.contains(cell) && floor_[cell] != 0;
}

std::vector<Point2> KnownFloor::occupied_now(const nav::FloorView& view,
                                             const std::vector<MapSegment>& segments) const {
  struct Thing {
    Point2 p_map;
    int cells = 0;
  };
  std::vector<Thing> things;
  const Grid<nav::CellState>& states = view.cost.states();
  for (std::size_t k = 0; k < states.cells().size(); ++k) {
    if (states.cells()[k] != nav::CellState::kOccupied) {
      continue;
    }
    const Point2 p = states.frame().centre_of(states.cell(k));
    if (!contains(p) || !seen_by_itself(view, p) || on_wall(p, segments)) {
      continue;
    }
    const auto same = std::find_if(things.begin(), things.end(),
                                   [&](const Thing& thing) { return (thing.p_map - p).norm() < kSameThing_m; });
    if (same == things.end()) {
      things.push_back({p, 1});
    } else {
      ++same->cells;
    }
  }
  std::vector<Point2> places;
  for (const Thing& thing : things) {
    if (thing.cells >= kThingCells) {
      places.push_back(thing.p_map);
    }
  }
  return places;
}

void KnownFloor::clear() { floor_ = {}; }

}  // namespace seeker::explore
