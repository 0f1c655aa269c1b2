#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "server/explore/openings.hpp"
#include "server/nav/visibility.hpp"

namespace seeker::explore {
namespace {

using nav::CellState;

/// Places to look from, this far before the face; the nearest reachable floor within kNearPlace_m of one will do.
constexpr std::array kViewDistances_m = {0.8, 1.2, 0.5};
constexpr double kNearPlace_m = 0.3;
/// A border that turns so much that the steps into the unknown cancel has no side to be looked at from.
constexpr double kOneSided = 0.5;

Point2 steps_into_unknown(const nav::CostMap& map, CellIndex cell) {
  Point2 sum = Point2::Zero();
  for (const CellIndex step : {CellIndex{1, 0}, CellIndex{-1, 0}, CellIndex{0, 1}, CellIndex{0, -1}}) {
    if (map.state({cell.i + step.i, cell.j + step.j}) == CellState::kUnknown) {
      sum += Point2(step.i, step.j);
    }
  }
  return sum;
}

/// Free floor too near to something for the robot to stand on, and beside the unknown.
bool is_edge(const nav::CostMap& map, CellIndex cell) {
  return map.state(cell) == CellState::kFree && !map.traversable(cell) && !steps_into_unknown(map, cell).isZero();
}

/// The connected edge that `seed` belongs to, taken out of `mark`, as far as `reach_cells` from the seed.
std::vector<CellIndex> take_edge(Grid<std::uint8_t>& mark, CellIndex seed, double reach_cells) {
  std::vector<CellIndex> cells{seed};
  mark[seed] = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        const CellIndex next{cells[k].i + di, cells[k].j + dj};
        if (mark.contains(next) && mark[next] != 0 && std::hypot(next.i - seed.i, next.j - seed.j) <= reach_cells) {
          mark[next] = 0;
          cells.push_back(next);
        }
      }
    }
  }
  return cells;
}

bool find_viewpoint(Opening& opening, const OpeningsInput& input, const ViewpointParams& params) {
  for (const double distance_m : kViewDistances_m) {
    const auto cell = input.costs.cheapest_near(opening.p_map - distance_m * opening.outward_map, kNearPlace_m);
    if (!cell) {
      continue;
    }
    const Point2 place = input.floor.cost.frame().centre_of(*cell);
    const Point2 to_face = opening.p_map - place;
    opening.map_T_view = {place.x(), place.y(), std::atan2(to_face.y(), to_face.x())};
    opening.cost = *input.costs.cost_to(*cell);
    if (well_in_view(opening, opening.map_T_view, input.floor.occupancy, params)) {
      return true;
    }
  }
  return false;
}

std::optional<Opening> opening_of(const std::vector<CellIndex>& edge, const OpeningsInput& input,
                                  const ViewpointParams& params) {
  const nav::CostMap& map = input.floor.cost;
  Point2 outward = Point2::Zero();
  Point2 mean = Point2::Zero();
  for (const CellIndex cell : edge) {
    outward += steps_into_unknown(map, cell);
    mean += map.frame().centre_of(cell);
  }
  if (outward.norm() < kOneSided * static_cast<double>(edge.size())) {
    return std::nullopt;
  }
  Opening opening;
  opening.kind = OpeningKind::kWallFace;
  opening.p_map = mean / static_cast<double>(edge.size());
  opening.outward_map = outward.normalized();
  opening.size_m = map.frame().resolution_m * static_cast<double>(edge.size());
  if (!input.areas.allows(opening.p_map) || !find_viewpoint(opening, input, params)) {
    return std::nullopt;
  }
  return opening;
}

}  // namespace

std::vector<Opening> wall_face_openings(const OpeningsInput& input, const ViewpointParams& params) {
  const nav::CostMap& map = input.floor.cost;
  Grid<std::uint8_t> mark(map.frame(), map.width(), map.height(), 0);
  std::vector<CellIndex> edges;
  for (CellIndex cell{0, 0}; cell.j < map.height(); ++cell.j) {
    for (cell.i = 0; cell.i < map.width(); ++cell.i) {
      if (is_edge(map, cell)) {
        mark[cell] = 1;
        edges.push_back(cell);
      }
    }
  }
  const double reach_cells = params.max_frontier_m / 2.0 / map.frame().resolution_m;
  const auto enough = static_cast<std::size_t>(params.min_face_m / map.frame().resolution_m);
  std::vector<Opening> openings;
  for (const CellIndex seed : edges) {
    if (mark[seed] == 0) {
      continue;
    }
    const std::vector<CellIndex> edge = take_edge(mark, seed, reach_cells);
    if (edge.size() < enough) {
      continue;
    }
    if (const auto opening = opening_of(edge, input, params)) {
      openings.push_back(*opening);
    }
  }
  return openings;
}

}  // namespace seeker::explore
