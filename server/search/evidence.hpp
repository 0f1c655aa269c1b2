/// \file
/// Evidence of what was searched: for each floor cell the probability that the target would have been seen if it were
/// there.
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
  double threshold = 0.5;  ///< a cell with at least this probability counts as covered
  /// Observations from places nearer to each other count as one: only the best of them is used.
  double independent_after_m = 0.4;
  /// Upper limit of the probability, because a recogniser may fail in all observations alike.
  double max_probability = 0.98;
  double min_gap_m2 = 0.04;  ///< smaller connected areas are not listed
};

/// Accumulates observations. Those of independent places combine as P = 1 - prod(1 - p_k), where p_k is the best
/// probability of all observations from place k. P never falls with more observations and is limited to
/// max_probability.
class EvidenceGrid {
 public:
  explicit EvidenceGrid(const EvidenceParams& params = {}, const HitRate& rate = {});

  /// Credits one picture taken from `camera_map` to every cell in range with line of sight through `occupancy` (cells
  /// as in OccupancyTile; unknown and occupied cells hide what lies behind). `target_size_m` is the size of the
  /// smallest target. Returns the added probability mass, cells x probability.
  double add_look(const Grid<std::uint8_t>& occupancy, const Point2& camera_map, double target_size_m);

  /// Uses what other robots have searched, with the same cells, as observations from separate places. It replaces
  /// earlier data of the others. Floor with cells of another size, or without cells, is ignored. No cells are copied.
  void set_others(const std::vector<SearchedFloor>& others);
  /// Takes observations of an earlier run that own_looks() gave, as one place apart from all others. Cells of another
  /// size are ignored. Call it once, before the first look.
  void take_back(const Grid<std::uint8_t>& looks);
  /// The evidence of this grid's own observations: all of it where that fits into a square of `side_cells`, otherwise
  /// the part within such a square around `middle_map`; empty where there is none.
  [[nodiscard]] Grid<std::uint8_t> own_looks(const Point2& middle_map, int side_cells) const;

  /// The probability mass that add_look would add within the cells of `wanted` (same cell size, 1 = count); the grid
  /// does not change.
  [[nodiscard]] double expected_gain(const Grid<std::uint8_t>& occupancy, const Grid<std::uint8_t>& wanted,
                                     const Point2& camera_map, double target_size_m) const;

  /// Probability at a place; 0 where no observation has been.
  [[nodiscard]] double probability_at(const Point2& p_map) const { return probability(frame().cell_of(p_map)); }
  /// The same for a cell of frame().
  [[nodiscard]] double probability(CellIndex cell) const;
  /// Cells lie on multiples of cell_m, indices may be negative.
  [[nodiscard]] GridFrame frame() const { return {Point2::Zero(), params_.cell_m}; }

  /// Moves all evidence, including that of other robots, when the map was corrected: `move` takes old map coordinates
  /// to new ones.
  void transform(const MapMove& move);
  /// Removes all observations, including those of other robots.
  void clear();

  /// The certificate of a search. `reachable`: grid of cell_m cells on multiples of cell_m, 1 = reachable floor (see
  /// nav::reachable_floor). `reason_of` gives the reason for floor that would be reachable but is forbidden or could
  /// not be reached; cells without a reason are ignored.
  using ReasonOf = std::function<std::optional<std::string>(const Point2&)>;
  [[nodiscard]] EvidenceReport report(const Grid<std::uint8_t>& reachable, const ReasonOf& reason_of) const;
  /// The numbers of the certificate alone.
  [[nodiscard]] CoverageSummary summary(const Grid<std::uint8_t>& reachable) const;

  [[nodiscard]] const EvidenceParams& params() const { return params_; }
  [[nodiscard]] const HitRate& hit_rate() const { return rate_; }

 private:
  /// Best probability for each place that has observed the cell.
  struct CellEvidence {
    std::vector<std::pair<std::uint32_t, float>> by_place;
  };
  /// Floor that another robot has searched, with the transform from the map into the frame of its grid.
  struct Other {
    SearchedFloor floor;
    Matrix2 grid_R_map;
    Point2 grid_t_map;
  };
  /// A box of cells, both ends included; empty where `first` lies behind `last`.
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
  /// Probability that all other robots would have missed a target in a cell of frame().
  [[nodiscard]] double others_miss(CellIndex cell) const;
  /// Box of this grid's own observations, as far as they lie in `within`.
  [[nodiscard]] CellBox box_of_looks(const CellBox& within) const;
  /// Probability from this grid's observations and those of the other robots.
  [[nodiscard]] double combined(Key key, const CellEvidence* evidence) const;
  [[nodiscard]] double combined_with(Key key, const CellEvidence* evidence, std::uint32_t place, double p) const;
  /// Probability that all observations miss.
  [[nodiscard]] static double miss_of(const CellEvidence& evidence, std::uint32_t place, double p);

  EvidenceParams params_;
  HitRate rate_;
  std::vector<Point2> places_;
  std::unordered_map<Key, CellEvidence> cells_;  ///< used for look-up only, so that its order never matters
  std::vector<Other> others_;
};

}  // namespace seeker::search
