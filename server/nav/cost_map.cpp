#include "server/nav/cost_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/occupancy_tile.hpp"
#include "server/nav/distance_transform.hpp"
#include "server/nav/ray.hpp"

namespace seeker::nav {
namespace {

CellState state_of(std::uint8_t cell, const CostMapParams& params) {
  if (cell == kUnknownCell) {
    return CellState::kUnknown;
  }
  const double probability = static_cast<double>(cell) / kOccupiedCell;
  if (probability >= params.occupied_probability) {
    return CellState::kOccupied;
  }
  return probability < params.free_probability ? CellState::kFree : CellState::kUnknown;
}

/// Calls visit(cell) for the cells of `frame` within the box low..high that lie in the grid.
template <class T, class Visit>
void for_cells_in_box(const Grid<T>& grid, const Point2& low, const Point2& high, const Visit& visit) {
  // Clamped as coordinates: a polygon corner may be farther away than an int can count cells.
  const GridFrame& frame = grid.frame();
  const Point2 far = frame.origin + frame.resolution_m * Point2(grid.width(), grid.height());
  const CellIndex first = frame.cell_of(low.cwiseMax(frame.origin).cwiseMin(far));
  const CellIndex last = frame.cell_of(high.cwiseMax(frame.origin).cwiseMin(far));
  for (int j = first.j; j <= std::min(last.j, grid.height() - 1); ++j) {
    for (int i = first.i; i <= std::min(last.i, grid.width() - 1); ++i) {
      visit(CellIndex{i, j});
    }
  }
}

void mark_polygon(Grid<std::uint8_t>& obstacles, const Polygon& polygon) {
  Point2 low = polygon.front();
  Point2 high = low;
  for (const Point2& corner : polygon) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  for_cells_in_box(obstacles, low, high, [&](CellIndex cell) {
    if (contains(polygon, obstacles.frame().centre_of(cell))) {
      obstacles[cell] = 1;
    }
  });
}

Status check(const Grid<std::uint8_t>& occupancy, const CostMapLimits& limits) {
  if (occupancy.empty()) {
    return fail(Errc::kInvalidArgument, "there is no occupancy to plan in yet; let the robot take a scan first");
  }
  if (limits.bound) {
    if (auto valid = validate_polygon(*limits.bound); !valid) {
      return fail_with_context("bound", valid.error());
    }
  }
  for (const Polygon& polygon : limits.keep_out) {
    if (auto valid = validate_polygon(polygon); !valid) {
      return fail_with_context("keep-out area", valid.error());
    }
  }
  return {};
}

}  // namespace

Result<CostMap> CostMap::build(const Grid<std::uint8_t>& occupancy, const CostMapParams& params,
                               const CostMapLimits& limits) {
  if (auto checked = check(occupancy, limits); !checked) {
    return tl::unexpected(checked.error());
  }
  CostMap map;
  map.params_ = params;
  map.bound_ = limits.bound;
  map.keep_out_ = limits.keep_out;
  map.states_ = Grid<CellState>(occupancy.frame(), occupancy.width(), occupancy.height());
  Grid<std::uint8_t> obstacles(occupancy.frame(), occupancy.width(), occupancy.height());
  for (std::size_t k = 0; k < occupancy.cells().size(); ++k) {
    map.states_.cells()[k] = state_of(occupancy.cells()[k], params);
    obstacles.cells()[k] = map.states_.cells()[k] == CellState::kOccupied ? 1 : 0;
  }
  for (const Polygon& polygon : limits.keep_out) {
    mark_polygon(obstacles, polygon);
  }
  for (const Point2& p : limits.obstacles) {
    for_cells_in_box(obstacles, p, p, [&](CellIndex cell) {
      obstacles[cell] = obstacles.frame().cell_of(p) == cell ? 1 : obstacles[cell];
    });
  }
  map.clearance_ = distance_transform(obstacles);
  map.compute_costs();
  map.forbid(limits);
  return map;
}

double CostMap::inflation_m() const {
  // The obstacle's surface is somewhere in its cell: up to half a cell nearer than the cell's centre.
  return params_.robot_radius_m + frame().resolution_m / 2.0;
}

UnreachableCause CostMap::obstruction(const Point2& p_map) const {
  if (bound_ && !contains(*bound_, p_map)) {
    return UnreachableCause::kOutsideBound;
  }
  for (const Polygon& polygon : keep_out_) {
    if (contains(polygon, p_map) || distance_to_edge_m(polygon, p_map) < inflation_m()) {
      return UnreachableCause::kKeptOut;
    }
  }
  const CellIndex cell = frame().cell_of(p_map);
  if (states_.contains(cell) && clearance_m(cell) < inflation_m()) {
    return UnreachableCause::kObstacle;
  }
  // What is left are discs that were forbidden: another robot, or a place that could not be reached before.
  return state(cell) == CellState::kUnknown ? UnreachableCause::kUnknownFloor : UnreachableCause::kBlocked;
}

void CostMap::compute_costs() {
  costs_ = Grid<float>(states_.frame(), states_.width(), states_.height(), 0.0F);
  const double resolution_m = frame().resolution_m;
  const double inflation_m = this->inflation_m();
  const double soft_m = std::max(params_.preferred_clearance_m - inflation_m, resolution_m);
  for (std::size_t k = 0; k < costs_.cells().size(); ++k) {
    const double clearance = resolution_m * static_cast<double>(clearance_.cells()[k]);
    clearance_.cells()[k] = static_cast<float>(clearance);
    const bool unknown = states_.cells()[k] == CellState::kUnknown;
    if (clearance < inflation_m || (unknown && !params_.unknown_traversable)) {
      continue;
    }
    const double nearness = std::max(0.0, 1.0 - (clearance - inflation_m) / soft_m);
    const double penalty = unknown ? params_.unknown_penalty : 0.0;
    costs_.cells()[k] = static_cast<float>(1.0 + params_.clearance_weight * nearness * nearness + penalty);
  }
}

void CostMap::forbid(const CostMapLimits& limits) {
  if (limits.bound) {
    for (std::size_t k = 0; k < costs_.cells().size(); ++k) {
      if (costs_.cells()[k] > 0.0F && !contains(*limits.bound, frame().centre_of(costs_.cell(k)))) {
        costs_.cells()[k] = 0.0F;
      }
    }
  }
  for (const Point2& p : limits.forbidden_discs) {
    forbid_disc(p, params_.robot_radius_m);
  }
}

void CostMap::forbid_disc(const Point2& centre_map, double radius_m) {
  const Point2 reach = Point2::Constant(radius_m);
  for_cells_in_box(costs_, centre_map - reach, centre_map + reach, [&](CellIndex cell) {
    if ((frame().centre_of(cell) - centre_map).norm() <= radius_m) {
      costs_[cell] = 0.0F;
    }
  });
}

CostMap CostMap::without_disc(const Point2& centre_map, double radius_m) const {
  CostMap map = *this;
  map.forbid_disc(centre_map, radius_m);
  return map;
}

bool CostMap::segment_is_clear(const Point2& a_map, const Point2& b_map) const {
  const GridFrame& f = frame();
  RayWalk walk((a_map - f.origin) / f.resolution_m, (b_map - f.origin) / f.resolution_m);
  do {
    if (!traversable(walk.cell())) {
      return false;
    }
  } while (walk.advance());
  return true;
}

std::optional<CellIndex> CostMap::nearest_traversable(const Point2& p_map, double radius_m) const {
  if (traversable(p_map)) {
    return frame().cell_of(p_map);
  }
  const auto leads_there = [&](CellIndex cell) {
    const GridFrame& f = frame();
    RayWalk walk((p_map - f.origin) / f.resolution_m, (f.centre_of(cell) - f.origin) / f.resolution_m);
    while (walk.advance()) {
      if (state(walk.cell()) == CellState::kOccupied) {
        return false;
      }
    }
    return true;
  };
  std::optional<CellIndex> best;
  double best_m = radius_m;
  const Point2 reach = Point2::Constant(radius_m);
  for_cells_in_box(costs_, p_map - reach, p_map + reach, [&](CellIndex cell) {
    const double d = (frame().centre_of(cell) - p_map).norm();
    if (traversable(cell) && d < best_m && leads_there(cell)) {
      best = cell;
      best_m = d;
    }
  });
  return best;
}

}  // namespace seeker::nav
