/// \file
/// Proof of what was searched: per floor cell, the probability that the target would have been seen were it there.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"
#include "common/core/searched_floor.hpp"
#include "server/search/hit_rate.hpp"
#include "server/search/search_types.hpp"

namespace seeker::search {

struct EvidenceParams {
  double cell_m = 0.2;
  double threshold = 0.5;            ///< a cell at or above it counts as covered
  double independent_after_m = 0.4;  ///< looks from nearer places are one look: only the best of them counts
  double max_probability = 0.98;     ///< no number of looks proves more: a recogniser can fail for all of them alike
  double min_gap_m2 = 0.04;          ///< smaller connected areas are not listed
};

/// Accumulates looks. Combination over independent places: P = 1 - prod(1 - p_k), where p_k is the best probability of
/// all looks from place k. Monotone in looks and bounded by max_probability.
class EvidenceGrid {
 public:
  explicit EvidenceGrid(const EvidenceParams& params = {}, const HitRate& rate = {});

  /// Credits one picture taken from `camera_map` to every cell in range with line of sight through `occupancy` (cells
  /// as in OccupancyTile; unknown and occupied cells hide what lies behind). `target_size_m`: the smallest of the
  /// targets looked for. Returns the probability mass added, cells x probability.
  double add_look(const Grid<std::uint8_t>& occupancy, const Point2& camera_map, double target_size_m);

  /// Takes what other robots have searched, with the same cells, for looks from places of their own; replaces what was
  /// said of them before. Floor with cells of another size, or without any, says nothing. Copies no cells.
  void set_others(const std::vector<SearchedFloor>& others);
  /// What this grid's own looks tell: all of it where that fits into a square of `side_cells`, else what lies within
  /// such a square around `middle_map`; empty where they tell nothing there.
  [[nodiscard]] Grid<std::uint8_t> own_looks(const Point2& middle_map, int side_cells) const;

  /// What add_look would add within the cells of `wanted` (same cell size, 1 = count), without adding it.
  [[nodiscard]] double expected_gain(const Grid<std::uint8_t>& occupancy, const Grid<std::uint8_t>& wanted,
                                     const Point2& camera_map, double target_size_m) const;

  /// Probability at a place; 0 where no look has been.
  [[nodiscard]] double probability_at(const Point2& p_map) const { return probability(frame().cell_of(p_map)); }
  /// The same by cell of frame().
  [[nodiscard]] double probability(CellIndex cell) const;
  /// Cells lie on multiples of cell_m, indices may be negative.
  [[nodiscard]] GridFrame frame() const { return {Point2::Zero(), params_.cell_m}; }

  /// Moves everything when a map epoch moved the map, what others have searched with it: `move` takes old map
  /// coordinates to new ones.
  void transform(const MapMove& move);
  /// Forgets all looks, those of others too.
  void clear();

  /// The certificate. `reachable`: grid of cell_m cells on multiples of cell_m, 1 = reachable floor (see
  /// nav::reachable_floor). `excluded`: floor that would be reachable but is forbidden or could not be reached, with
  /// the reason per cell; cells given no reason are ignored.
  using ReasonOf = std::function<std::optional<std::string>(const Point2&)>;
  [[nodiscard]] EvidenceReport report(const Grid<std::uint8_t>& reachable, const ReasonOf& reason_of) const;
  /// Numbers only.
  [[nodiscard]] CoverageSummary summary(const Grid<std::uint8_t>& reachable) const;

  [[nodiscard]] const EvidenceParams& params() const { return params_; }
  [[nodiscard]] const HitRate& hit_rate() const { return rate_; }

 private:
  /// Best probability per place that has seen the cell.
  struct CellEvidence {
    std::vector<std::pair<std::uint32_t, float>> by_place;
  };
  /// Floor that another robot has searched, and where a place of the map lies in the frame of its grid.
  struct Other {
    SearchedFloor floor;
    Matrix2 grid_R_map;
    Point2 grid_t_map;
  };
  /// Cells, both ends included; nothing where `first` lies behind `last`.
  struct CellBox {
    CellIndex first;
    CellIndex last;
    [[nodiscard]] bool contains(CellIndex c) const {
      return c.i >= first.i && c.j >= first.j && c.i <= last.i && c.j <= last.j;
    }
  };
  using Key = std::uint64_t;
  [[nodiscard]] static Key key_of(CellIndex cell);
  [[nodiscard]] static CellIndex cell_of(Key key);
  [[nodiscard]] std::uint32_t place_of(const Point2& camera_map) const;
  [[nodiscard]] static Other other_from(SearchedFloor floor);
  /// That all others would have missed a target in a cell of frame().
  [[nodiscard]] double others_miss(CellIndex cell) const;
  /// Of this grid's own looks, as far as they lie in `within`.
  [[nodiscard]] CellBox box_of_looks(const CellBox& within) const;
  /// With what others say of the cell.
  [[nodiscard]] double combined(Key key, const CellEvidence* evidence) const;
  [[nodiscard]] double combined_with(Key key, const CellEvidence* evidence, std::uint32_t place, double p) const;
  /// That all looks miss.
  [[nodiscard]] static double miss_of(const CellEvidence& evidence, std::uint32_t place, double p);

  EvidenceParams params_;
  HitRate rate_;
  std::vector<Point2> places_;
  std::unordered_map<Key, CellEvidence> cells_;  ///< looked up only, never walked in an order that matters
  std::vector<Other> others_;
};

}  // namespace seeker::search
