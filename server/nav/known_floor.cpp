#include "server/nav/known_floor.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/occupancy_tile.hpp"
#include "common/core/polygon.hpp"

namespace seeker::nav {
namespace {

/// Occupied cells within this distance of each other are one object; fewer cells are noise.
constexpr double kSameObject_m = 1.0;
constexpr std::size_t kObjectCells = 3;
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

bool holds(const Grid<std::uint8_t>& floor, const Point2& p_map) {
  const CellIndex cell = floor.frame().cell_of(p_map);
  return floor.contains(cell) && floor[cell] != 0;
}

/// The same floor in the map after it moved, its cells again on multiples of their size.
Grid<std::uint8_t> moved(const Grid<std::uint8_t>& floor, const MapMove& move) {
  if (floor.empty()) {
    return {};
  }
  const double cell_m = floor.frame().resolution_m;
  const auto first =
      std::find_if(floor.cells().begin(), floor.cells().end(), [](std::uint8_t cell) { return cell != 0; });
  if (first == floor.cells().end()) {
    return {};
  }
  Point2 low = move * floor.frame().centre_of(floor.cell(static_cast<std::size_t>(first - floor.cells().begin())));
  Point2 high = low;
  for (std::size_t k = 0; k < floor.cells().size(); ++k) {
    if (floor.cells()[k] != 0) {
      const Point2 p = move * floor.frame().centre_of(floor.cell(k));
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  low -= Point2::Constant(cell_m);
  high += Point2::Constant(cell_m);
  const GridFrame frame{cell_m * (low / cell_m).array().floor().matrix(), cell_m};
  const Point2 cells = ((high - frame.origin) / cell_m).array().ceil().matrix();
  Grid<std::uint8_t> out(frame, static_cast<int>(cells.x()), static_cast<int>(cells.y()), 0);
  const MapMove back = inverse(move);
  for (std::size_t k = 0; k < out.cells().size(); ++k) {
    out.cells()[k] = holds(floor, back * frame.centre_of(out.cell(k))) ? 1 : 0;
  }
  return out;
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

/// Both, of the new one what is wanted.
template <class Wanted>
Grid<std::uint8_t> joined(const Grid<std::uint8_t>& old, const Grid<std::uint8_t>& added, Wanted&& wanted) {
  Grid<std::uint8_t> both = covering(old, added);
  copy_into(both, old, [](const Point2&) { return true; });
  copy_into(both, added, wanted);
  return both;
}

}  // namespace

bool on_wall(const Point2& p_map, const std::vector<MapSegment>& segments) {
  return std::any_of(segments.begin(), segments.end(), [&](const MapSegment& segment) {
    return segment.length_m >= kShortestWall_m &&
           distance_to_segment_m(segment.left(), segment.right(), p_map) < kWallBand_m;
  });
}

bool seen_by_itself(const FloorView& view, const Point2& p_map) {
  if (!view.own) {
    return true;
  }
  const Grid<std::uint8_t>& own = view.own->occupancy;
  const CellIndex cell = own.frame().cell_of(p_map);
  return own.contains(cell) && own[cell] != kUnknownCell;
}

void KnownFloor::add(const FloorView& view, const Point2& robot_map, double near_m) {
  const Grid<std::uint8_t>& reachable = view.own ? view.own->reachable : view.reachable;
  if (reachable.cells().empty()) {
    return;
  }
  const auto all = [](const Point2&) { return true; };
  const auto near = [&](const Point2& p) { return (p - robot_map).squaredNorm() <= near_m * near_m; };
  floor_ = joined(floor_, reachable, near);
  from_afar_ = joined(from_afar_, reachable, all);
  const double cell_m = reachable.frame().resolution_m;
  present_m2_ = cell_m * cell_m *
                static_cast<double>(std::count_if(reachable.cells().begin(), reachable.cells().end(),
                                                  [](std::uint8_t cell) { return cell != 0; }));
}

bool KnownFloor::contains(const Point2& p_map) const { return holds(floor_, p_map); }

bool KnownFloor::was_reachable(const Point2& p_map) const { return holds(from_afar_, p_map); }

std::vector<StandingObject> KnownFloor::occupied_now(const FloorView& view,
                                                     const std::vector<MapSegment>& segments) const {
  std::vector<StandingObject> objects;
  const Grid<CellState>& states = view.cost.states();
  for (std::size_t k = 0; k < states.cells().size(); ++k) {
    if (states.cells()[k] != CellState::kOccupied) {
      continue;
    }
    const Point2 p = states.frame().centre_of(states.cell(k));
    if (!contains(p) || !seen_by_itself(view, p) || on_wall(p, segments)) {
      continue;
    }
    const auto same = std::find_if(objects.begin(), objects.end(), [&](const StandingObject& object) {
      return (object.p_map - p).norm() < kSameObject_m;
    });
    if (same == objects.end()) {
      objects.push_back({p, {states.cell(k)}});
    } else {
      same->cells.push_back(states.cell(k));
    }
  }
  std::erase_if(objects, [](const StandingObject& object) { return object.cells.size() < kObjectCells; });
  return objects;
}

void KnownFloor::transform(const MapMove& move) {
  floor_ = moved(floor_, move);
  from_afar_ = moved(from_afar_, move);
}

}  // namespace seeker::nav
