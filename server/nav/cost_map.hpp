/// \file
/// Where the robot's centre may go, and how gladly: the occupancy inflated by the robot's radius.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/polygon.hpp"
#include "common/core/result.hpp"

namespace seeker::nav {

enum class CellState : std::uint8_t { kFree, kOccupied, kUnknown };

struct CostMapParams {
  double robot_radius_m = 0.27;         ///< Pioneer 3-DX: 0.25 m and a margin
  double preferred_clearance_m = 0.60;  ///< from an obstacle to the robot's centre; farther costs nothing more
  double clearance_weight = 3.0;        ///< a metre along the inflated border costs 1 + this
  double occupied_probability = 0.6;    ///< at or above: occupied
  double free_probability = 0.45;       ///< below: free; between: unknown
  bool unknown_traversable = false;     ///< true: plan through what nobody has seen
  double unknown_penalty = 2.0;         ///< added to the cost of a metre through unknown cells
};

/// What limits motion besides the occupancy, all in the frame `map`.
struct CostMapLimits {
  std::optional<Polygon> bound;   ///< the robot's centre stays inside
  std::vector<Polygon> keep_out;  ///< the whole footprint stays outside
  std::vector<Point2> obstacles;  ///< extra obstacle points, e.g. sonar echoes below the lidar's plane
  /// Centres of discs of robot radius that the robot's centre may not enter: places that failed before.
  std::vector<Point2> forbidden_discs;
};

/// Immutable; build a new one when the occupancy has changed enough (about 10 ns per cell).
class CostMap {
 public:
  /// `occupancy` holds cells as in OccupancyTile (OccupancyMap::snapshot()). kInvalidArgument: empty grid, or a polygon
  /// that validate_polygon refuses.
  [[nodiscard]] static Result<CostMap> build(const Grid<std::uint8_t>& occupancy, const CostMapParams& params = {},
                                             const CostMapLimits& limits = {});

  [[nodiscard]] const GridFrame& frame() const { return states_.frame(); }
  [[nodiscard]] int width() const { return states_.width(); }
  [[nodiscard]] int height() const { return states_.height(); }
  [[nodiscard]] const CostMapParams& params() const { return params_; }

  /// True where the robot's centre may be. Outside the grid is unknown.
  [[nodiscard]] bool traversable(const Point2& p_map) const { return traversable(frame().cell_of(p_map)); }
  [[nodiscard]] bool traversable(CellIndex cell) const { return cost(cell) > 0.0F; }
  [[nodiscard]] CellState state(CellIndex cell) const {
    return states_.contains(cell) ? states_[cell] : CellState::kUnknown;
  }
  /// Cost of one metre through the cell, >= 1; 0 where the robot's centre may not be.
  [[nodiscard]] float cost(CellIndex cell) const { return costs_.contains(cell) ? costs_[cell] : 0.0F; }
  /// Distance from the cell's centre to the centre of the nearest occupied cell, metres (large where there is none).
  [[nodiscard]] float clearance_m(CellIndex cell) const { return clearance_.contains(cell) ? clearance_[cell] : 0.0F; }
  [[nodiscard]] const Grid<CellState>& states() const { return states_; }

  /// The same map with a disc that the robot's centre may not enter.
  [[nodiscard]] CostMap without_disc(const Point2& centre_map, double radius_m) const;

  /// True when the straight way from a to b stays on traversable cells.
  [[nodiscard]] bool way_is_clear(const Point2& a_map, const Point2& b_map) const;
  /// The nearest traversable cell within `radius_m`, one that can be reached without crossing an occupied cell first;
  /// nothing when there is none.
  [[nodiscard]] std::optional<CellIndex> nearest_traversable(const Point2& p_map, double radius_m) const;

 private:
  CostMap() = default;
  void compute_costs();
  void forbid(const CostMapLimits& limits);
  void forbid_disc(const Point2& centre_map, double radius_m);

  CostMapParams params_;
  Grid<CellState> states_;
  Grid<float> clearance_;
  Grid<float> costs_;
};

}  // namespace seeker::nav
