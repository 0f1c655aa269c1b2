#include "common/core/occupancy_tile.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/core/assert.hpp"

namespace seeker {
namespace {

/// Of a cell, along one axis.
int tile_of(int cell) { return cell >= 0 ? cell / kTileSide_cells : (cell + 1) / kTileSide_cells - 1; }

}  // namespace

std::optional<Grid<std::uint8_t>> assemble(const std::vector<OccupancyTile>& tiles) {
  if (tiles.empty()) {
    return std::nullopt;
  }
  CellIndex low = tiles.front().index;
  CellIndex high = low;
  for (const OccupancyTile& tile : tiles) {
    low = {std::min(low.i, tile.index.i), std::min(low.j, tile.index.j)};
    high = {std::max(high.i, tile.index.i), std::max(high.j, tile.index.j)};
  }
  const GridFrame frame{kTileSide_cells * kTileResolution_m * Point2(low.i, low.j), kTileResolution_m};
  Grid<std::uint8_t> grid(frame, (high.i - low.i + 1) * kTileSide_cells, (high.j - low.j + 1) * kTileSide_cells,
                          kUnknownCell);
  for (const OccupancyTile& tile : tiles) {
    for (int row = 0; row < kTileSide_cells; ++row) {
      const auto* from = tile.cells.data() + static_cast<std::ptrdiff_t>(row) * kTileSide_cells;
      const CellIndex start{(tile.index.i - low.i) * kTileSide_cells, (tile.index.j - low.j) * kTileSide_cells + row};
      std::copy_n(from, kTileSide_cells, grid.cells().begin() + static_cast<std::ptrdiff_t>(grid.index(start)));
    }
  }
  return grid;
}

std::vector<OccupancyTile> cut(const Grid<std::uint8_t>& grid) {
  SEEKER_ASSERT(grid.frame().resolution_m == kTileResolution_m);
  const Point2 first = grid.frame().origin / kTileResolution_m;
  const CellIndex low{static_cast<int>(std::lround(first.x())), static_cast<int>(std::lround(first.y()))};
  std::map<std::pair<int, int>, OccupancyTile> tiles;
  for (CellIndex c{0, 0}; c.j < grid.height(); ++c.j) {
    for (c.i = 0; c.i < grid.width(); ++c.i) {
      if (grid[c] == kUnknownCell) {
        continue;
      }
      const CellIndex cell{low.i + c.i, low.j + c.j};
      const CellIndex index{tile_of(cell.i), tile_of(cell.j)};
      auto [tile, is_new] = tiles.try_emplace({index.i, index.j});
      if (is_new) {
        tile->second.index = index;
        tile->second.cells.fill(kUnknownCell);
      }
      const CellIndex local{cell.i - index.i * kTileSide_cells, cell.j - index.j * kTileSide_cells};
      tile->second.cells[static_cast<std::size_t>(local.j * kTileSide_cells + local.i)] = grid[c];
    }
  }
  std::vector<OccupancyTile> all;
  all.reserve(tiles.size());
  for (const auto& [index, tile] : tiles) {
    all.push_back(tile);
  }
  return all;
}

double free_area_m2(const std::optional<Grid<std::uint8_t>>& map) {
  if (!map) {
    return 0.0;
  }
  const auto free = std::count_if(map->cells().begin(), map->cells().end(),
                                  [](std::uint8_t cell) { return cell != kUnknownCell && cell < kOccupiedCell / 2; });
  return static_cast<double>(free) * map->frame().resolution_m * map->frame().resolution_m;
}

}  // namespace seeker
