#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/text.hpp"
#include "server/explore/openings.hpp"
#include "server/nav/frontiers.hpp"

namespace seeker::explore {
namespace {

using nav::CellState;

std::array<CellIndex, 4> neighbours(CellIndex c) {
  return {{{c.i + 1, c.j}, {c.i - 1, c.j}, {c.i, c.j + 1}, {c.i, c.j - 1}}};
}

/// Whether the unknown part that `seed` belongs to has at least `enough` cells.
bool large_unknown(const nav::CostMap& map, CellIndex seed, std::size_t enough) {
  std::vector<CellIndex> part{seed};
  for (std::size_t k = 0; k < part.size(); ++k) {
    if (part.size() >= enough || !map.states().contains(part[k])) {
      return true;
    }
    for (const CellIndex next : neighbours(part[k])) {
      if (map.state(next) == CellState::kUnknown && std::find(part.begin(), part.end(), next) == part.end()) {
        part.push_back(next);
      }
    }
  }
  return part.size() >= enough;
}

/// A stretch of a frontier no longer than max_frontier_m, by its cheapest cell.
struct Piece {
  std::vector<CellIndex> cells;
};

std::vector<Piece> cut(const nav::Frontier& frontier, const OpeningsInput& input, double max_length_m) {
  std::vector<CellIndex> left = frontier.cells;
  const auto cost = [&](CellIndex c) { return *input.costs.cost_to(c); };
  std::stable_sort(left.begin(), left.end(), [&](CellIndex a, CellIndex b) { return cost(a) < cost(b); });
  const double reach_cells = max_length_m / 2.0 / input.floor.cost.frame().resolution_m;
  std::vector<Piece> pieces;
  while (!left.empty()) {
    Piece piece;
    const CellIndex seed = left.front();
    const auto far = std::stable_partition(
        left.begin(), left.end(), [&](CellIndex c) { return std::hypot(c.i - seed.i, c.j - seed.j) <= reach_cells; });
    piece.cells.assign(left.begin(), far);
    left.erase(left.begin(), far);
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

double length_of(const Piece& piece, const OpeningsInput& input) {
  return input.floor.cost.frame().resolution_m * static_cast<double>(piece.cells.size());
}

/// Cells of unknown floor beside the piece that the robot may explore.
struct Beyond {
  Point2 direction = Point2::Zero();  ///< sum of unit steps into the unknown
  std::size_t cells = 0;
  bool large = false;
};

Beyond look_beyond(const Piece& piece, const OpeningsInput& input, std::size_t enough_cells) {
  const nav::CostMap& map = input.floor.cost;
  Beyond beyond;
  for (const CellIndex cell : piece.cells) {
    for (const CellIndex next : neighbours(cell)) {
      if (map.state(next) != CellState::kUnknown || !input.areas.allows(map.frame().centre_of(next))) {
        continue;
      }
      beyond.direction += Point2(next.i - cell.i, next.j - cell.j);
      ++beyond.cells;
      beyond.large = beyond.large || large_unknown(map, next, enough_cells);
    }
  }
  return beyond;
}

std::optional<Opening> opening_of(const Piece& piece, const OpeningsInput& input, const ViewpointParams& params) {
  const nav::CostMap& map = input.floor.cost;
  const double resolution_m = map.frame().resolution_m;
  const auto enough = static_cast<std::size_t>(params.min_pocket_m2 / (resolution_m * resolution_m));
  const Beyond beyond = look_beyond(piece, input, enough);
  if (!beyond.large) {
    return std::nullopt;
  }
  Opening opening;
  opening.kind = OpeningKind::kFrontier;
  opening.p_map = map.frame().centre_of(piece.cells.front());
  const Point2 from_robot = opening.p_map - input.map_T_base.translation();
  const Point2 outward = beyond.direction.squaredNorm() > 0.5 ? beyond.direction : from_robot;
  opening.outward_map = outward.norm() > 0.0 ? Point2(outward.normalized()) : Point2(Point2::UnitX());
  opening.cost = *input.costs.cost_to(piece.cells.front());
  opening.map_T_view = {opening.p_map.x(), opening.p_map.y(),
                        std::atan2(opening.outward_map.y(), opening.outward_map.x())};
  return opening;
}

}  // namespace

std::vector<Opening> frontier_openings(const OpeningsInput& input, const ViewpointParams& params) {
  std::vector<Opening> openings;
  for (const nav::Frontier& frontier : nav::find_frontiers(input.floor.cost, input.costs, params.min_frontier_m)) {
    const std::vector<Piece> pieces = cut(frontier, input, params.max_frontier_m);
    for (const Piece& piece : pieces) {
      // One that was not cut is as long as what the robot's body keeps it from, too.
      const double length_m = pieces.size() == 1 ? frontier.length_m : length_of(piece, input);
      if (length_m < params.min_frontier_m) {
        continue;
      }
      if (auto opening = opening_of(piece, input, params)) {
        opening->size_m = length_m;
        openings.push_back(*opening);
      }
    }
  }
  return openings;
}

std::vector<CutOffFloor> cut_off_floor(const nav::CostMap& map, const nav::DistanceField& costs, double min_m2) {
  const double cell_m2 = map.frame().resolution_m * map.frame().resolution_m;
  Grid<std::uint8_t> seen(map.frame(), map.width(), map.height(), 0);
  std::vector<CutOffFloor> parts;
  for (CellIndex seed{0, 0}; seed.j < map.height(); ++seed.j) {
    for (seed.i = 0; seed.i < map.width(); ++seed.i) {
      const auto is_part = [&](CellIndex c) { return map.traversable(c) && !costs.cost_to(c) && seen[c] == 0; };
      if (!is_part(seed)) {
        continue;
      }
      std::vector<CellIndex> part{seed};
      seen[seed] = 1;
      for (std::size_t k = 0; k < part.size(); ++k) {
        for (const CellIndex next : neighbours(part[k])) {
          if (is_part(next)) {
            seen[next] = 1;
            part.push_back(next);
          }
        }
      }
      const double area_m2 = cell_m2 * static_cast<double>(part.size());
      if (area_m2 >= min_m2) {
        parts.push_back({map.frame().centre_of(part[part.size() / 2]), std::move(part), area_m2});
      }
    }
  }
  return parts;
}

UnreachablePlace unreachable_place(const CutOffFloor& floor) {
  return {floor.p_map, UnreachableCause::kCutOff, std::sqrt(floor.area_m2),
          "no path leads to the " + text(floor.area_m2) + " m\xC2\xB2 of floor that are seen there"};
}

}  // namespace seeker::explore
