#include "server/nav/shared_floor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/core/assert.hpp"
#include "common/core/occupancy_tile.hpp"
#include "server/nav/cost_map.hpp"

namespace seeker::nav {
namespace {

/// Corners in cells of the grid that begins at the frame's origin.
struct CellBox {
  CellIndex low;
  CellIndex high;  ///< one beyond the last

  [[nodiscard]] Grid<std::uint8_t> unknown() const {
    const Point2 origin = kTileResolution_m * Point2(low.i, low.j);
    return {{origin, kTileResolution_m}, high.i - low.i, high.j - low.j, kUnknownCell};
  }
};

CellIndex first_cell(const Grid<std::uint8_t>& grid) {
  const Point2 cells = grid.frame().origin / kTileResolution_m;
  return {static_cast<int>(std::lround(cells.x())), static_cast<int>(std::lround(cells.y()))};
}

CellBox box_of(const Grid<std::uint8_t>& grid) {
  const CellIndex low = first_cell(grid);
  return {low, {low.i + grid.width(), low.j + grid.height()}};
}

CellBox box_around(const Grid<std::uint8_t>& grid, const Pose2& new_T_old) {
  const GridFrame& frame = grid.frame();
  Point2 low = new_T_old * frame.origin;
  Point2 high = low;
  for (const CellIndex corner : {CellIndex{grid.width(), 0}, {0, grid.height()}, {grid.width(), grid.height()}}) {
    const Point2 p = new_T_old * Point2(frame.origin + frame.resolution_m * Point2(corner.i, corner.j));
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const auto cell = [](double at_m) { return static_cast<int>(std::floor(at_m / kTileResolution_m)); };
  return {{cell(low.x()), cell(low.y())}, {cell(high.x()) + 1, cell(high.y()) + 1}};
}

// What a cell says to those who plan on it with default parameters.
bool is_free(std::uint8_t cell) { return cell < CostMapParams{}.free_probability * kOccupiedCell; }
bool is_occupied(std::uint8_t cell) {
  return cell >= CostMapParams{}.occupied_probability * kOccupiedCell && cell != kUnknownCell;
}
bool says_nothing(std::uint8_t cell) { return !is_free(cell) && !is_occupied(cell); }

void paste(const Grid<std::uint8_t>& from, CellIndex low, Grid<std::uint8_t>& to) {
  const CellIndex first = first_cell(from);
  for (CellIndex c{0, 0}; c.j < from.height(); ++c.j) {
    for (c.i = 0; c.i < from.width(); ++c.i) {
      std::uint8_t& cell = to[{first.i + c.i - low.i, first.j + c.j - low.j}];
      cell = says_nothing(cell) && from[c] != kUnknownCell ? from[c] : cell;
    }
  }
}

constexpr std::array<CellIndex, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// A grid within the common box.
struct Source {
  const Grid<std::uint8_t>& grid;
  CellIndex first;  ///< its first cell in the common box

  [[nodiscard]] std::uint8_t at(CellIndex cell) const {
    const CellIndex mine{cell.i - first.i, cell.j - first.j};
    return grid.contains(mine) ? grid[mine] : kUnknownCell;
  }
  /// The value of a cell that it saw occupied within kSameWall_m; unknown: there is none.
  [[nodiscard]] std::uint8_t wall_near(CellIndex cell) const {
    const auto reach = static_cast<int>(std::lround(kSameWall_m / kTileResolution_m));
    std::uint8_t most = kUnknownCell;
    for (int dj = -reach; dj <= reach; ++dj) {
      for (int di = -reach; di <= reach; ++di) {
        const std::uint8_t value = at({cell.i + di, cell.j + dj});
        most = is_occupied(value) && (most == kUnknownCell || value > most) ? value : most;
      }
    }
    return most;
  }
};

/// Unknown cells beside floor that only one of the two saw, where the other one saw a wall.
void close_borders(const Source& own, const Source& other, Grid<std::uint8_t>& all) {
  for (CellIndex cell{0, 0}; cell.j < all.height(); ++cell.j) {
    for (cell.i = 0; cell.i < all.width(); ++cell.i) {
      if (!is_free(all[cell])) {
        continue;
      }
      const bool is_own = !says_nothing(own.at(cell));
      for (const CellIndex step : kBeside) {
        const CellIndex beyond{cell.i + step.i, cell.j + step.j};
        if (!all.contains(beyond) || !says_nothing(all[beyond])) {
          continue;
        }
        if (const std::uint8_t wall = (is_own ? other : own).wall_near(beyond); wall != kUnknownCell) {
          all[beyond] = wall;
        }
      }
    }
  }
}

}  // namespace

Grid<std::uint8_t> carried(const Grid<std::uint8_t>& floor, const Pose2& new_T_old) {
  Grid<std::uint8_t> out = box_around(floor, new_T_old).unknown();
  const Pose2 old_T_new = inverse(new_T_old);
  for (CellIndex c{0, 0}; c.j < out.height(); ++c.j) {
    for (c.i = 0; c.i < out.width(); ++c.i) {
      const CellIndex old = floor.frame().cell_of(old_T_new * out.frame().centre_of(c));
      if (floor.contains(old)) {
        out[c] = floor[old];
      }
    }
  }
  return out;
}

Grid<std::uint8_t> with_known(const Grid<std::uint8_t>& own, const Grid<std::uint8_t>& other) {
  SEEKER_ASSERT(own.frame().resolution_m == kTileResolution_m && other.frame().resolution_m == kTileResolution_m);
  const CellBox a = box_of(own);
  const CellBox b = box_of(other);
  // A cell more on all sides, for walls that end floor at the edge of a grid.
  const CellBox both{{std::min(a.low.i, b.low.i) - 1, std::min(a.low.j, b.low.j) - 1},
                     {std::max(a.high.i, b.high.i) + 1, std::max(a.high.j, b.high.j) + 1}};
  Grid<std::uint8_t> out = both.unknown();
  paste(own, both.low, out);
  paste(other, both.low, out);
  const auto within = [&](const CellBox& box) { return CellIndex{box.low.i - both.low.i, box.low.j - both.low.j}; };
  close_borders({own, within(a)}, {other, within(b)}, out);
  return out;
}

SharedFloor carried(const std::vector<std::pair<Pose2, SharedFloor>>& floors) {
  std::optional<Grid<std::uint8_t>> all;
  for (const auto& [here_T_map, floor] : floors) {
    Grid<std::uint8_t> here = carried(*floor, here_T_map);
    all = all ? with_known(*all, here) : std::move(here);
  }
  return all ? std::make_shared<const Grid<std::uint8_t>>(*std::move(all)) : nullptr;
}

}  // namespace seeker::nav
