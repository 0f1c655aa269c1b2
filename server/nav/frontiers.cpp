#include "server/nav/frontiers.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace seeker::nav {
namespace {

bool beside_unknown(const CostMap& map, CellIndex cell) {
  for (const CellIndex next : {CellIndex{cell.i + 1, cell.j}, CellIndex{cell.i - 1, cell.j},
                               CellIndex{cell.i, cell.j + 1}, CellIndex{cell.i, cell.j - 1}}) {
    if (map.state(next) == CellState::kUnknown) {
      return true;
    }
  }
  return false;
}

/// Takes one connected border out of `mark`.
Frontier take_frontier(Grid<std::uint8_t>& mark, const DistanceField& costs, CellIndex seed) {
  Frontier frontier;
  frontier.p_map = mark.frame().centre_of(seed);
  frontier.cost = *costs.cost_to(seed);
  std::vector<CellIndex>& cells = frontier.cells;
  cells.push_back(seed);
  mark[seed] = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const CellIndex cell = cells[k];
    if (const double cost = *costs.cost_to(cell); cost < frontier.cost) {
      frontier.cost = cost;
      frontier.p_map = mark.frame().centre_of(cell);
    }
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        const CellIndex next{cell.i + di, cell.j + dj};
        if (mark.contains(next) && mark[next] != 0) {
          mark[next] = 0;
          cells.push_back(next);
        }
      }
    }
  }
  return frontier;
}

/// Cells of the border that go on from `cells` where the robot's centre cannot be, no farther than its radius keeps it
/// from what the border ends at: a border along a whole wall is none of a gap's width.
std::size_t cells_beside(const CostMap& map, const std::vector<CellIndex>& cells) {
  const int steps = static_cast<int>(std::ceil(map.params().robot_radius_m / map.frame().resolution_m));
  std::set<CellIndex> beside;
  std::vector<CellIndex> ring = cells;
  for (int step = 0; step < steps && !ring.empty(); ++step) {
    std::vector<CellIndex> next_ring;
    for (const CellIndex cell : ring) {
      for (int dj = -1; dj <= 1; ++dj) {
        for (int di = -1; di <= 1; ++di) {
          const CellIndex next{cell.i + di, cell.j + dj};
          const bool goes_on =
              map.state(next) == CellState::kFree && !map.traversable(next) && beside_unknown(map, next);
          if (goes_on && beside.insert(next).second) {
            next_ring.push_back(next);
          }
        }
      }
    }
    ring = std::move(next_ring);
  }
  return beside.size();
}

}  // namespace

std::vector<Frontier> find_frontiers(const CostMap& map, const DistanceField& costs, double min_length_m) {
  Grid<std::uint8_t> mark(map.frame(), map.width(), map.height(), 0);
  std::vector<CellIndex> border;
  for (CellIndex cell{0, 0}; cell.j < map.height(); ++cell.j) {
    for (cell.i = 0; cell.i < map.width(); ++cell.i) {
      if (map.traversable(cell) && beside_unknown(map, cell) && costs.cost_to(cell)) {
        mark[cell] = 1;
        border.push_back(cell);
      }
    }
  }
  std::vector<Frontier> frontiers;
  for (const CellIndex cell : border) {
    if (mark[cell] != 0) {
      Frontier frontier = take_frontier(mark, costs, cell);
      const std::size_t length_cells = frontier.cells.size() + cells_beside(map, frontier.cells);
      frontier.length_m = map.frame().resolution_m * static_cast<double>(length_cells);
      if (frontier.length_m >= min_length_m) {
        frontiers.push_back(std::move(frontier));
      }
    }
  }
  std::stable_sort(frontiers.begin(), frontiers.end(),
                   [](const Frontier& a, const Frontier& b) { return a.cost < b.cost; });
  return frontiers;
}

bool border_near(const CostMap& map, const Point2& p_map, double radius_m) {
  const CellIndex low = map.frame().cell_of(p_map - Point2::Constant(radius_m));
  const CellIndex high = map.frame().cell_of(p_map + Point2::Constant(radius_m));
  for (CellIndex cell = low; cell.j <= high.j; ++cell.j) {
    for (cell.i = low.i; cell.i <= high.i; ++cell.i) {
      const bool near = (map.frame().centre_of(cell) - p_map).norm() <= radius_m;
      if (near && map.traversable(cell) && beside_unknown(map, cell)) {
        return true;
      }
    }
  }
  return false;
}

bool near_any(const Point2& p_map, const std::vector<Point2>& places, double radius_m) {
  return std::any_of(places.begin(), places.end(), [&](const Point2& q) { return (q - p_map).norm() < radius_m; });
}

}  // namespace seeker::nav
