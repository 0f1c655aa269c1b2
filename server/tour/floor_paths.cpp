#include "server/tour/floor_paths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <queue>
#include <utility>

namespace seeker::tour {
namespace {

constexpr std::array<CellIndex, 16> kSteps{{{1, 0},
                                            {-1, 0},
                                            {0, 1},
                                            {0, -1},
                                            {1, 1},
                                            {1, -1},
                                            {-1, 1},
                                            {-1, -1},
                                            {1, 2},
                                            {1, -2},
                                            {-1, 2},
                                            {-1, -2},
                                            {2, 1},
                                            {2, -1},
                                            {-2, 1},
                                            {-2, -1}}};
constexpr std::uint8_t kNoStep = kSteps.size();

CellIndex plus(CellIndex cell, CellIndex step) { return {cell.i + step.i, cell.j + step.j}; }

float length_of(CellIndex step) { return std::hypot(static_cast<float>(step.i), static_cast<float>(step.j)); }

int sign(int value) { return (value > 0) - (value < 0); }

}  // namespace

FloorPaths::FloorPaths(const Grid<std::uint8_t>& floor, const Point2& from, const Point2* until)
    : floor_(&floor),
      lengths_(floor.frame(), floor.width(), floor.height(), std::numeric_limits<float>::infinity()),
      came_by_(floor.frame(), floor.width(), floor.height(), kNoStep) {
  const CellIndex start = floor.frame().cell_of(from);
  if (!floor.contains(start) || floor[start] == 0) {
    return;
  }
  if (until == nullptr) {
    spread(start, nullptr);
  } else {
    const CellIndex last = floor.frame().cell_of(*until);
    spread(start, &last);
  }
}

/// Cells beside the step count too: a path must not squeeze through a corner.
bool FloorPaths::step_is_free(CellIndex from, CellIndex step) const {
  const auto is_floor = [&](CellIndex cell) { return floor_->contains(cell) && (*floor_)[cell] != 0; };
  const CellIndex to = plus(from, step);
  if (!is_floor(to)) {
    return false;
  }
  const bool straight = step.i == 0 || step.j == 0;
  if (straight) {
    return true;
  }
  const CellIndex diagonal{sign(step.i), sign(step.j)};
  if (std::abs(step.i) == std::abs(step.j)) {
    return is_floor({from.i + step.i, from.j}) && is_floor({from.i, from.j + step.j});
  }
  const CellIndex along = std::abs(step.i) > std::abs(step.j) ? CellIndex{diagonal.i, 0} : CellIndex{0, diagonal.j};
  return is_floor(plus(from, diagonal)) && is_floor(plus(from, along));
}

void FloorPaths::spread(CellIndex from, const CellIndex* until) {
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  lengths_[from] = 0.0F;
  open.emplace(0.0F, lengths_.index(from));
  while (!open.empty()) {
    const auto [length, index] = open.top();
    open.pop();
    const CellIndex cell = lengths_.cell(index);
    if (length > lengths_[cell]) {
      continue;
    }
    if (until != nullptr && cell == *until) {
      return;
    }
    for (std::size_t k = 0; k < kSteps.size(); ++k) {
      const CellIndex next = plus(cell, kSteps[k]);
      if (!floor_->contains(next)) {
        continue;
      }
      const float longer = length + length_of(kSteps[k]);
      if (longer < lengths_[next] && step_is_free(cell, kSteps[k])) {
        lengths_[next] = longer;
        came_by_[next] = static_cast<std::uint8_t>(k);
        open.emplace(longer, lengths_.index(next));
      }
    }
  }
}

double FloorPaths::length_m(const Point2& to) const {
  const CellIndex cell = lengths_.frame().cell_of(to);
  return lengths_.contains(cell) ? lengths_.frame().resolution_m * static_cast<double>(lengths_[cell]) : kNoPath;
}

std::vector<Point2> FloorPaths::path_to(const Point2& to) const {
  CellIndex cell = lengths_.frame().cell_of(to);
  if (!lengths_.contains(cell) || !std::isfinite(lengths_[cell])) {
    return {};
  }
  std::vector<Point2> path{lengths_.frame().centre_of(cell)};
  while (came_by_[cell] != kNoStep) {
    const CellIndex step = kSteps[came_by_[cell]];
    cell = {cell.i - step.i, cell.j - step.j};
    path.push_back(lengths_.frame().centre_of(cell));
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace seeker::tour
