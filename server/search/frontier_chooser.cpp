#include <algorithm>

#include "server/search/goal_chooser.hpp"

namespace seeker::search {
namespace {

bool beside_unknown(const nav::CostMap& map, CellIndex cell) {
  for (const CellIndex next : {CellIndex{cell.i + 1, cell.j}, CellIndex{cell.i - 1, cell.j},
                               CellIndex{cell.i, cell.j + 1}, CellIndex{cell.i, cell.j - 1}}) {
    if (map.state(next) == nav::CellState::kUnknown) {
      return true;
    }
  }
  return false;
}

/// Takes one connected border out of `mark`.
Frontier take_frontier(Grid<std::uint8_t>& mark, const nav::DistanceField& costs, CellIndex seed) {
  Frontier frontier;
  frontier.p_map = mark.frame().centre_of(seed);
  frontier.cost = *costs.cost_to(seed);
  std::vector<CellIndex> open{seed};
  mark[seed] = 0;
  while (!open.empty()) {
    const CellIndex cell = open.back();
    open.pop_back();
    frontier.length_m += mark.frame().resolution_m;
    if (const double cost = *costs.cost_to(cell); cost < frontier.cost) {
      frontier.cost = cost;
      frontier.p_map = mark.frame().centre_of(cell);
    }
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        const CellIndex next{cell.i + di, cell.j + dj};
        if (mark.contains(next) && mark[next] != 0) {
          mark[next] = 0;
          open.push_back(next);
        }
      }
    }
  }
  return frontier;
}

}  // namespace

std::vector<Frontier> find_frontiers(const nav::CostMap& map, const nav::DistanceField& costs, double min_length_m) {
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
      const Frontier frontier = take_frontier(mark, costs, cell);
      if (frontier.length_m >= min_length_m) {
        frontiers.push_back(frontier);
      }
    }
  }
  std::stable_sort(frontiers.begin(), frontiers.end(),
                   [](const Frontier& a, const Frontier& b) { return a.cost < b.cost; });
  return frontiers;
}

bool near_any(const Point2& p_map, const std::vector<Point2>& places, double radius_m) {
  return std::any_of(places.begin(), places.end(), [&](const Point2& q) { return (q - p_map).norm() < radius_m; });
}

std::optional<Goal> FrontierChooser::choose(const ChooseInput& input) {
  for (const Frontier& frontier : find_frontiers(input.floor.cost, input.costs, params_.min_frontier_m)) {
    if (!near_any(frontier.p_map, input.unreachable, params_.failed_radius_m) &&
        !near_any(frontier.p_map, seen_frontiers_, params_.frontier_reach_m)) {
      return Goal{frontier.p_map, "nearest frontier", true, 0.0};
    }
  }
  return std::nullopt;
}

void FrontierChooser::visited(const Goal& goal, const Pose2& /*map_T_base*/) { seen_frontiers_.push_back(goal.p_map); }

void FrontierChooser::transform(const Pose2& new_T_old) {
  for (Point2& p : seen_frontiers_) {
    p = new_T_old * p;
  }
}

}  // namespace seeker::search
