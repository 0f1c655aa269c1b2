/// \file
/// Occupancy travels and is stored in square tiles, so that a growing map is never sent whole twice.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/grid.hpp"

namespace seeker {

inline constexpr int kTileSide_cells = 64;
inline constexpr double kTileResolution_m = 0.05;
inline constexpr std::uint8_t kUnknownCell = 255;
inline constexpr std::uint8_t kOccupiedCell = 254;  ///< probability 1

/// Tile (i, j): row-major, row 0 at the lowest y, lower-left corner at (i, j) * 64 * 0.05 m in the frame `map`.
/// A cell holds probability of occupied * 254, or kUnknownCell.
struct OccupancyTile {
  CellIndex index;
  std::uint64_t revision = 0;  ///< of the map at the tile's last change; rises only
  std::array<std::uint8_t, static_cast<std::size_t>(kTileSide_cells) * kTileSide_cells> cells{};

  friend bool operator==(const OccupancyTile&, const OccupancyTile&) = default;
};

/// Joins tiles into the smallest grid that holds them all; std::nullopt for an empty list.
[[nodiscard]] std::optional<Grid<std::uint8_t>> assemble(const std::vector<OccupancyTile>& tiles);

/// Cuts a grid into tiles and leaves out those with unknown cells only. The grid must have the resolution of tiles, and
/// its origin must lie on a multiple of it.
[[nodiscard]] std::vector<OccupancyTile> cut(const Grid<std::uint8_t>& grid);

/// Area of the known cells that are rather free than occupied, of a map as assemble() makes it.
[[nodiscard]] double free_area_m2(const std::optional<Grid<std::uint8_t>>& map);

}  // namespace seeker
