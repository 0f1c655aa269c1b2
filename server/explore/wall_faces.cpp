#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "server/explore/openings.hpp"
#include "server/nav/visibility.hpp"

namespace seeker::explore {
namespace {

using nav::CellState;

/// Where to stand: distances from the face.
constexpr std::array<double, 5> kViewDistances_m{0.8, 1.2, 1.8, 2.5, 0.5};
/// A border whose direction changes so much that the steps into the unknown cancel has no side to be observed from.
constexpr double kOneSided = 0.5;
/// The side of a mapped wall counts as mapped so far before it and behind it: the grid and the wall are a little apart.
constexpr double kBefore_m = 0.25;
constexpr double kBehind_m = 0.15;
/// Shorter segments may be of what stands before a wall.
constexpr double kShortest_m = 0.3;
/// A wall that was seen is observed again from this length on; a shorter one is mostly furniture.
constexpr double kShortestSeen_m = 1.0;
/// A step leads into a wall when this much of it goes across.
constexpr double kAcross = 0.2;

constexpr std::array<CellIndex, 4> kSteps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

Point2 direction(CellIndex step) { return {static_cast<double>(step.i), static_cast<double>(step.j)}; }

/// The steps that lead into a wall, one bit each, as in kSteps. `into_map`: unit vector from free space into it.
std::uint8_t steps_into(const Point2& into_map) {
  unsigned bits = 0;
  for (std::size_t k = 0; k < kSteps.size(); ++k) {
    bits |= direction(kSteps[k]).dot(into_map) > kAcross ? 1U << k : 0U;
  }
  return static_cast<std::uint8_t>(bits);
}

void mark_side(const MappedSide& side, const GridFrame& frame, Grid<std::uint8_t>& steps_at) {
  const double length_m = (side.right_map - side.left_map).norm();
  if (length_m < kShortest_m) {
    return;
  }
  const Point2 along = (side.right_map - side.left_map) / length_m;
  const Point2 into(-along.y(), along.x());
  const std::uint8_t steps = steps_into(into);
  const double step_m = 0.5 * frame.resolution_m;
  for (double x = 0.0; x <= length_m; x += step_m) {
    for (double y = -kBefore_m; y <= kBehind_m; y += step_m) {
      const CellIndex cell = frame.cell_of(side.left_map + x * along + y * into);
      if (steps_at.contains(cell)) {
        steps_at[cell] = static_cast<std::uint8_t>(steps_at[cell] | steps);
      }
    }
  }
}

/// For every cell about mapped walls the steps from it that lead into one, from the side that is mapped.
Grid<std::uint8_t> mapped_steps(const OpeningsInput& input) {
  const nav::CostMap& map = input.floor.cost;
  Grid<std::uint8_t> steps_at(map.frame(), map.width(), map.height(), 0);
  for (const MapSegment& segment : input.segments) {
    mark_side({segment.left(), segment.right()}, map.frame(), steps_at);
  }
  for (const MappedSide& side : input.others_sides) {
    mark_side(side, map.frame(), steps_at);
  }
  return steps_at;
}

/// Where borders are looked for. A map without any segment says nothing of which walls are mapped.
struct Borders {
  const nav::CostMap& map;
  Grid<std::uint8_t> mapped;
  bool seen_faces = false;

  /// Sum of the steps into what is not mapped: the unknown, and walls that no segment holds.
  [[nodiscard]] Point2 steps_out(CellIndex cell) const {
    Point2 sum = Point2::Zero();
    for (std::size_t k = 0; k < kSteps.size(); ++k) {
      const CellState beyond = map.state({cell.i + kSteps[k].i, cell.j + kSteps[k].j});
      const bool left = beyond == CellState::kUnknown || (seen_faces && beyond == CellState::kOccupied);
      if (left && (mapped[cell] & (1U << k)) == 0) {
        sum += direction(kSteps[k]);
      }
    }
    return sum;
  }
  [[nodiscard]] bool beside_unknown(CellIndex cell) const {
    return std::any_of(kSteps.begin(), kSteps.end(), [&](CellIndex step) {
      return map.state({cell.i + step.i, cell.j + step.j}) == CellState::kUnknown;
    });
  }
  /// Free floor that is too near to an obstacle for the robot to stand on, and beside what is not mapped.
  [[nodiscard]] bool is_edge(CellIndex cell) const {
    return map.state(cell) == CellState::kFree && !map.traversable(cell) && !steps_out(cell).isZero();
  }
};

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

bool long_enough(const std::vector<CellIndex>& edge, const Borders& borders, const ViewpointParams& params) {
  const double cell_m = borders.map.frame().resolution_m;
  const auto unseen =
      std::count_if(edge.begin(), edge.end(), [&](CellIndex cell) { return borders.beside_unknown(cell); });
  return cell_m * static_cast<double>(unseen) >= params.min_face_m ||
         cell_m * static_cast<double>(edge.size()) >= kShortestSeen_m;
}

std::optional<Opening> opening_of(const std::vector<CellIndex>& edge, const Borders& borders,
                                  const OpeningsInput& input, const ViewpointParams& params) {
  const nav::CostMap& map = input.floor.cost;
  Point2 outward = Point2::Zero();
  Point2 mean = Point2::Zero();
  for (const CellIndex cell : edge) {
    outward += borders.steps_out(cell);
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
  if (!input.areas.allows(opening.p_map) ||
      !find_viewpoint(opening, {opening.p_map, opening.outward_map, kViewDistances_m}, input, params)) {
    return std::nullopt;
  }
  return opening;
}

}  // namespace

std::vector<Opening> wall_face_openings(const OpeningsInput& input, const ViewpointParams& params) {
  const nav::CostMap& map = input.floor.cost;
  const Borders borders{map, mapped_steps(input), input.seen_faces && !input.segments.empty()};
  Grid<std::uint8_t> mark(map.frame(), map.width(), map.height(), 0);
  std::vector<CellIndex> edges;
  for (CellIndex cell{0, 0}; cell.j < map.height(); ++cell.j) {
    for (cell.i = 0; cell.i < map.width(); ++cell.i) {
      if (borders.is_edge(cell)) {
        mark[cell] = 1;
        edges.push_back(cell);
      }
    }
  }
  const double reach_cells = params.max_frontier_m / 2.0 / map.frame().resolution_m;
  std::vector<Opening> openings;
  for (const CellIndex seed : edges) {
    if (mark[seed] == 0) {
      continue;
    }
    const std::vector<CellIndex> edge = take_edge(mark, seed, reach_cells);
    if (!long_enough(edge, borders, params)) {
      continue;
    }
    if (const auto opening = opening_of(edge, borders, input, params)) {
      openings.push_back(*opening);
    }
  }
  return openings;
}

}  // namespace seeker::explore
