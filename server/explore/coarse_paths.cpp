#include "server/explore/coarse_paths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <queue>
#include <utility>

#include "server/tour/nearest_cell.hpp"

namespace seeker::explore {
namespace {

constexpr std::array<CellIndex, 8> kSteps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

/// Dijkstra that ends when every cell of `targets` has its length.
Grid<float> spread(const Grid<std::uint8_t>& floor, CellIndex start, const std::vector<CellIndex>& targets) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  Grid<float> lengths(floor.frame(), floor.width(), floor.height(), kFar);
  Grid<std::uint8_t> wanted(floor.frame(), floor.width(), floor.height(), 0);
  std::size_t left = 0;
  for (const CellIndex target : targets) {
    left += wanted[target] == 0 ? 1 : 0;
    wanted[target] = 1;
  }
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  lengths[start] = 0.0F;
  open.emplace(0.0F, lengths.index(start));
  while (!open.empty() && left > 0) {
    const auto [length, index] = open.top();
    open.pop();
    const CellIndex cell = lengths.cell(index);
    if (length > lengths[cell]) {
      continue;
    }
    left -= wanted[cell];
    wanted[cell] = 0;
    for (const CellIndex step : kSteps) {
      const CellIndex next{cell.i + step.i, cell.j + step.j};
      if (!floor.contains(next) || floor[next] == 0) {
        continue;
      }
      const float longer = length + (step.i != 0 && step.j != 0 ? std::numbers::sqrt2_v<float> : 1.0F);
      if (longer < lengths[next]) {
        lengths[next] = longer;
        open.emplace(longer, lengths.index(next));
      }
    }
  }
  return lengths;
}

}  // namespace

std::vector<double> CoarsePaths::lengths_m(const Point2& from_map, const std::vector<Point2>& to_map) const {
  std::vector<double> lengths(to_map.size(), kNoPath);
  const auto start = tour::nearest_cell(*floor_, from_map);
  if (!start) {
    return lengths;
  }
  std::vector<std::optional<CellIndex>> cells;
  std::vector<CellIndex> targets;
  cells.reserve(to_map.size());
  targets.reserve(to_map.size());
  for (const Point2& p : to_map) {
    cells.push_back(tour::nearest_cell(*floor_, p));
    if (cells.back()) {
      targets.push_back(*cells.back());
    }
  }
  const Grid<float> reached = spread(*floor_, *start, targets);
  for (std::size_t k = 0; k < to_map.size(); ++k) {
    if (cells[k]) {
      // Two places in one cell are still apart.
      const double path_m = floor_->frame().resolution_m * static_cast<double>(reached[*cells[k]]);
      lengths[k] = std::max(path_m, (to_map[k] - from_map).norm());
    }
  }
  return lengths;
}

std::vector<double> CoarsePaths::expected_m(const Point2& from_map, const std::vector<Point2>& to_map) const {
  constexpr double kDetour = 1.5;  ///< of the straight line
  std::vector<double> lengths = lengths_m(from_map, to_map);
  for (std::size_t k = 0; k < to_map.size(); ++k) {
    if (!std::isfinite(lengths[k])) {
      lengths[k] = kDetour * (to_map[k] - from_map).norm();
    }
  }
  return lengths;
}

}  // namespace seeker::explore
