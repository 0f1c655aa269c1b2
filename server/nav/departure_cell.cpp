#include "server/nav/departure_cell.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "common/core/angle.hpp"
#include "server/nav/flood.hpp"
#include "server/nav/ray.hpp"

namespace seeker::nav {
namespace {

/// Whether the robot's body passes from `p_map` to the cell over floor that is known to be free and not forbidden. What
/// inflation leaves of a gap may be nothing only because both of its sides were taken half a cell too near: that much
/// is forgiven.
bool body_passes(const CostMap& map, const Point2& p_map, CellIndex to) {
  const GridFrame& f = map.frame();
  const double half_cell_m = f.resolution_m / 2.0;
  const double radius_m = map.params().robot_radius_m;
  const double needed_m = std::min<double>(radius_m, map.clearance_m(f.cell_of(p_map))) - half_cell_m;
  RayWalk walk((p_map - f.origin) / f.resolution_m, (f.centre_of(to) - f.origin) / f.resolution_m);
  while (walk.advance()) {
    const double clearance_m = map.clearance_m(walk.cell());
    const bool forbidden = !map.traversable(walk.cell()) && clearance_m >= radius_m + half_cell_m;
    if (map.state(walk.cell()) != CellState::kFree || clearance_m < needed_m || forbidden) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<CellIndex> connected_cells(const CostMap& map, CellIndex start, std::size_t enough) {
  Grid<std::uint8_t> seen(map.frame(), map.width(), map.height());
  seen[start] = 1;
  const auto enter = [&](CellIndex next) {
    const bool is_new = map.traversable(next) && seen[next] == 0;
    if (is_new) {
      seen[next] = 1;
    }
    return is_new;
  };
  return flood(start, enter, enough);
}

std::optional<CellIndex> departure_cell(const CostMap& map, const Point2& p_map, double radius_m) {
  const auto nearest = map.nearest_traversable(p_map, radius_m);
  if (!nearest) {
    return std::nullopt;
  }
  // Floor that would fit into the search circle is too small to lead anywhere.
  const GridFrame& f = map.frame();
  const double circle_m2 = kPi * radius_m * radius_m;
  const auto enough = static_cast<std::size_t>(std::ceil(circle_m2 / (f.resolution_m * f.resolution_m)));
  const std::vector<CellIndex> around = connected_cells(map, *nearest, enough);
  if (around.size() >= enough) {
    return nearest;
  }
  std::set<CellIndex> islands(around.begin(), around.end());
  std::optional<CellIndex> best;
  double best_m = radius_m;
  const int reach = static_cast<int>(std::ceil(radius_m / f.resolution_m));
  const CellIndex middle = f.cell_of(p_map);
  for (CellIndex cell{0, middle.j - reach}; cell.j <= middle.j + reach; ++cell.j) {
    for (cell.i = middle.i - reach; cell.i <= middle.i + reach; ++cell.i) {
      const double d = (f.centre_of(cell) - p_map).norm();
      if (d >= best_m || !map.traversable(cell) || islands.contains(cell) || !body_passes(map, p_map, cell)) {
        continue;
      }
      const std::vector<CellIndex> floor = connected_cells(map, cell, enough);
      if (floor.size() >= enough) {
        best = cell;
        best_m = d;
      } else {
        islands.insert(floor.begin(), floor.end());
      }
    }
  }
  return best ? best : nearest;
}

}  // namespace seeker::nav
