/// \file
/// Lists and counters of the coverage algorithm: searched and unsearched positions, passes, escapes (spec S3.3).
#pragma once

#include <cstdint>
#include <optional>

#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"
#include "server/search/search_types.hpp"

namespace seeker::search {

/// Eq (1): N0 = ceil(S / (3 S_e)), at least 1. S: free area, S_e: area of a cell.
[[nodiscard]] int passes_limit(double area_m2, double cell_area_m2);

/// Eqs (2) and (3): the cell beside the robot that the sonar at bearing alpha_s points to.
/// x_s = (d + r) cos alpha_s, y_s = (d + r) sin alpha_s, moved to the map; theta_o = theta_r + alpha_s.
[[nodiscard]] Pose2 potential_cell(const Pose2& map_T_base, double alpha_s_rad, double d_m, double r_m);

/// State of the position that the robot has reached (steps 1 and 2).
enum class Arrival : std::uint8_t {
  kFresh,       ///< never searched: recognise here, then step 4
  kPass,        ///< searched before, n < N: step 4
  kSearchWell,  ///< searched before and n reached N: step 3
};

/// The lists and the counter n with its limit N. "In list" means a Chebyshev distance of at most d/2.
class CoverageLists {
 public:
  CoverageLists(double cell_m, int passes_limit);

  /// Step 1: a potential cell, appended to unsearched when it is in neither list (nor known as unreachable).
  bool note_potential(const Point2& p_map);
  /// Steps 1 and 2 for the position reached.
  Arrival arrive(const Point2& p_map);
  /// Step 3: the unsearched position to escape to. Nothing: the list is empty.
  [[nodiscard]] std::optional<Point2> nearest_unsearched(const Point2& p_map) const;
  /// Step 3, arrival: removed from unsearched, added to searched, n <- 0, N <- max(1, floor(N/2)).
  void escaped(const Point2& goal_map, const Point2& p_map);
  /// Step 3, when no path was found: the position is removed from unsearched and remembered as unreachable.
  void drop_unreachable(const Point2& goal_map);

  void transform(const MapMove& move);
  /// Goes on from the lists and the counters of an earlier run; those of cells of another size are ignored.
  void take_back(const GridLists& lists);
  [[nodiscard]] bool searched(const Point2& p_map) const;
  [[nodiscard]] const GridLists& lists() const { return lists_; }

 private:
  [[nodiscard]] bool in_list(const std::vector<Point2>& list, const Point2& p_map) const;
  void remove_unsearched(const Point2& p_map);

  GridLists lists_;
};

}  // namespace seeker::search
