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

/// Log-odds are natural logarithms. A wall needs two sweeps to be believed, and a cell that people have left is free
/// again after at most (max - min) / -miss = 7 sweeps: moving people do not become walls.
struct OccupancyParams {
  double max_range_m = 12.0;        ///< a longer ray is cut here and clears only
  double no_return_clear_m = 4.0;   ///< a beam without return clears up to here; 0: it says nothing
  double log_odds_hit = 0.9;        ///< > 0
  double log_odds_miss = -0.6;      ///< < 0
  double log_odds_min = -2.0;       ///< clamp of the sum
  double log_odds_max = 2.4;        ///< clamp of the sum
  double sonar_max_range_m = 3.0;   ///< beyond it, an echo marks nothing and clears up to here
  double sonar_log_odds_hit = 0.4;  ///< weak: the echo came from anywhere on the arc
  double sonar_log_odds_miss = -0.3;
  double sonar_log_odds_limit = 1.2;  ///< sonar never pushes a cell beyond this, nor moves one that is beyond it
  int max_tiles = 2048;               ///< 2048 tiles = 21 000 m2 and 24 MB
};

/// Occupancy of the frame `map`. Within one sweep each cell is updated once and a hit wins over a miss, so that grazing
/// beams do not erase a wall. Sonar writes into the same layer, weaker than the lidar: where both are fitted the lidar
/// wins, so obstacles below the lidar's plane must be given to CostMap as extra obstacles.
class OccupancyMap {
 public:
  explicit OccupancyMap(const OccupancyParams& params = {});

  /// Writes one sweep taken from `map_T_base`. kInvalidArgument: unusable scan or pose, nothing is written.
  /// kTooLarge: the map is at max_tiles; what lies inside the present tiles is still written.
  [[nodiscard]] Status integrate(const LaserScan& scan, const Pose2& map_T_base);
  /// Writes the newest readings of a ring as cones. Errors as above. No echo writes nothing: smooth walls swallow it.
  [[nodiscard]] Status integrate(const SonarScan& scan, const Pose2& map_T_base);

  /// Rises with every integrate() that changed a cell, and with clear(); 0 for a new map.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  /// Tiles changed after `revision`, ordered by row and column.
  [[nodiscard]] std::vector<OccupancyTile> tiles_since(std::uint64_t revision) const;
  /// Probability of occupied; nothing where no beam has been.
  [[nodiscard]] std::optional<double> probability_at(const Point2& p_map) const;
  /// Everything known in one grid (cells as in OccupancyTile); nothing for an empty map.
  [[nodiscard]] std::optional<Grid<std::uint8_t>> snapshot() const;
  [[nodiscard]] std::size_t tile_count() const { return tiles_.size(); }
  /// Forgets everything; the revision still rises.
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
  /// What one sweep adds: log-odds step and the interval it may move cells in.
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
