#include "common/core/occupancy_tile.hpp"

#include <algorithm>

namespace seeker {

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

}  // namespace seeker
