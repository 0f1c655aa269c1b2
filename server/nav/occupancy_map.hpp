/// \file
/// The growing occupancy map: 64x64 tiles of log-odds, written by exact ray traversal.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/occupancy_tile.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"

namespace seeker::nav {

/// Log-odds are natural logarithms. A wall is mapped after two sweeps, and a cell that people have left is free again
/// after at most (max - min) / -miss = 7 sweeps, so that moving people do not become walls.
struct OccupancyParams {
  double max_range_m = 12.0;        ///< a longer ray is cut here and only clears cells
  double no_return_clear_m = 4.0;   ///< a beam without return clears up to here; 0: it clears nothing
  double log_odds_hit = 0.9;        ///< added for a hit, above 0
  double log_odds_miss = -0.6;      ///< added for a miss, below 0
  double log_odds_min = -2.0;       ///< lower limit of the sum
  double log_odds_max = 2.4;        ///< upper limit of the sum
  double sonar_max_range_m = 3.0;   ///< an echo from farther away marks nothing and clears up to here
  double sonar_log_odds_hit = 0.4;  ///< small, because the echo came from anywhere on the arc
  double sonar_log_odds_miss = -0.3;
  /// Sonar never moves a cell beyond this, and leaves a cell that is beyond it unchanged.
  double sonar_log_odds_limit = 1.2;
  int max_tiles = 2048;  ///< 2048 tiles = 21 000 m2 and 24 MB
};

/// Occupancy of the frame `map`. Within one sweep each cell is updated once and a hit wins over a miss, so that grazing
/// beams do not erase a wall. Sonar writes into the same layer with smaller steps than the lidar. Where both are fitted
/// the lidar wins, so obstacles below the lidar's plane must be given to CostMap as extra obstacles.
class OccupancyMap {
 public:
  explicit OccupancyMap(const OccupancyParams& params = {});

  /// Writes one sweep taken from `map_T_base`. kInvalidArgument: the scan or the pose is unusable; nothing is written.
  /// kTooLarge: the map has max_tiles tiles; what lies inside them is still written.
  [[nodiscard]] Status integrate(const LaserScan& scan, const Pose2& map_T_base);
  /// Writes the newest readings of a sonar ring as cones, with errors as above. A reading without echo writes nothing,
  /// because smooth walls reflect the sound away.
  [[nodiscard]] Status integrate(const SonarScan& scan, const Pose2& map_T_base);

  /// Rises with every integrate() that changed a cell, and with clear(); 0 for a new map.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  /// Tiles changed after `revision`, ordered by row and column.
  [[nodiscard]] std::vector<OccupancyTile> tiles_since(std::uint64_t revision) const;
  /// Occupancy probability of the cell at the place. Nothing: no beam has crossed it.
  [[nodiscard]] std::optional<double> probability_at(const Point2& p_map) const;
  /// All known cells in one grid (cells as in OccupancyTile). Nothing: the map is empty.
  [[nodiscard]] std::optional<Grid<std::uint8_t>> snapshot() const;
  [[nodiscard]] std::size_t tile_count() const { return tiles_.size(); }
  /// Removes all cells; the revision still rises.
  void clear();

 private:
  static constexpr std::size_t kTileCells = static_cast<std::size_t>(kTileSide_cells) * kTileSide_cells;

  /// Log-odds in steps of kLogOddsStep; kUnseen where no beam has been.
  struct Tile {
    std::array<std::int8_t, kTileCells> value;
    std::array<std::uint16_t, kTileCells> sweep;  ///< the sweep that wrote the cell last
    std::uint64_t revision = 0;
    bool changed = false;
  };
  /// The effect of one sweep on a cell: the log-odds step and the interval in which it may move the cell.
  struct Evidence {
    int step = 0;
    int low = 0;
    int high = 0;
    bool weak = false;  ///< leaves cells alone that are already beyond [low, high]
  };

  /// A cell of the infinite grid, and a pointer to the tile the last access touched.
  struct Cursor {
    CellIndex tile_index{};
    Tile* tile = nullptr;
    bool valid = false;
  };

  [[nodiscard]] Tile* tile_at(CellIndex tile_index);
  void begin_sweep();
  [[nodiscard]] Status end_sweep();
  void write(CellIndex cell, const Evidence& evidence, Cursor& cursor);
  void clear_ray(const Point2& from_map, const Point2& to_map, const Evidence& miss);
  void write_hits(const LaserScan& scan, const Pose2& map_T_laser);
  void clear_beams(const LaserScan& scan, const Pose2& map_T_laser);
  void mark_echo(const SonarReading& reading, double half_angle_rad, const Pose2& map_T_base);
  void clear_cone(const SonarReading& reading, double half_angle_rad, const Pose2& map_T_base);

  OccupancyParams params_;
  Evidence hit_;
  Evidence miss_;
  Evidence sonar_hit_;
  Evidence sonar_miss_;
  std::unordered_map<std::uint64_t, std::unique_ptr<Tile>> tiles_;
  std::vector<Tile*> touched_;
  std::uint64_t revision_ = 0;
  std::uint16_t sweep_ = 0;
  bool overflow_ = false;
};

}  // namespace seeker::nav
