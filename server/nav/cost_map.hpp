/// \file
/// The cost of driving through each cell for the robot's centre: the occupancy inflated by the robot's radius.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/polygon.hpp"
#include "common/core/result.hpp"
#include "common/core/unreachable.hpp"

namespace seeker::nav {

enum class CellState : std::uint8_t { kFree, kOccupied, kUnknown };

struct CostMapParams {
  double robot_radius_m = 0.27;  ///< radius of the robot's footprint (default: Pioneer 3-DX, 0.25 m and a margin)
  /// Distance between an obstacle and the robot's centre beyond which there is no extra cost.
  double preferred_clearance_m = 0.60;
  double clearance_weight = 3.0;      ///< a metre along the inflated border costs 1 + this
  double occupied_probability = 0.6;  ///< a cell with at least this occupancy probability is occupied
  double free_probability = 0.45;  ///< a cell below this probability is free; between the two thresholds it is unknown
  bool unknown_traversable = false;  ///< true: paths may lead through cells that no robot has observed
  double unknown_penalty = 2.0;      ///< added to the cost of a metre through unknown cells
};

/// What limits motion besides the occupancy, all in the frame `map`.
struct CostMapLimits {
  std::optional<Polygon> bound;   ///< area that the robot's centre must stay inside
  std::vector<Polygon> keep_out;  ///< areas that the whole footprint must stay outside of
  std::vector<Point2> obstacles;  ///< extra obstacle points, e.g. sonar echoes below the lidar's plane
  /// Centres of discs of robot radius that the robot's centre may not enter: places where driving failed before.
  std::vector<Point2> forbidden_discs;
};

/// Cost map of one occupancy grid. It is immutable; build a new one when the occupancy has changed enough (about 10 ns
/// per cell).
class CostMap {
 public:
  /// Builds the map from `occupancy`, which holds cells as in OccupancyTile (OccupancyMap::snapshot()).
  /// kInvalidArgument: the grid is empty, or validate_polygon refuses one of the polygons.
  [[nodiscard]] static Result<CostMap> build(const Grid<std::uint8_t>& occupancy, const CostMapParams& params = {},
                                             const CostMapLimits& limits = {});

  [[nodiscard]] const GridFrame& frame() const { return states_.frame(); }
  [[nodiscard]] int width() const { return states_.width(); }
  [[nodiscard]] int height() const { return states_.height(); }
  [[nodiscard]] const CostMapParams& params() const { return params_; }

  /// Whether the robot's centre may be at the place. Places outside the grid are unknown.
  [[nodiscard]] bool traversable(const Point2& p_map) const { return traversable(frame().cell_of(p_map)); }
  [[nodiscard]] bool traversable(CellIndex cell) const { return cost(cell) > 0.0F; }
  [[nodiscard]] CellState state(CellIndex cell) const {
    return states_.contains(cell) ? states_[cell] : CellState::kUnknown;
  }
  /// Cost of one metre through the cell, at least 1; 0 where the robot's centre may not be.
  [[nodiscard]] float cost(CellIndex cell) const { return costs_.contains(cell) ? costs_[cell] : 0.0F; }
  /// Distance from the cell's centre to the centre of the nearest occupied cell, in metres (large where there is none).
  [[nodiscard]] float clearance_m(CellIndex cell) const { return clearance_.contains(cell) ? clearance_[cell] : 0.0F; }
  [[nodiscard]] const Grid<CellState>& states() const { return states_; }
  /// Why the robot's centre may not be at a place that is not traversable.
  [[nodiscard]] UnreachableCause obstruction(const Point2& p_map) const;

  /// The same map with a disc that the robot's centre may not enter.
  [[nodiscard]] CostMap without_disc(const Point2& centre_map, double radius_m) const;

  /// Whether the straight segment from a to b stays on traversable cells.
  [[nodiscard]] bool segment_is_clear(const Point2& a_map, const Point2& b_map) const;
  /// The nearest traversable cell within `radius_m` that can be reached without crossing an occupied cell first.
  /// Nothing: there is none.
  [[nodiscard]] std::optional<CellIndex> nearest_traversable(const Point2& p_map, double radius_m) const;

 private:
  CostMap() = default;
  void compute_costs();
  void forbid(const CostMapLimits& limits);
  void forbid_disc(const Point2& centre_map, double radius_m);

  /// Least distance from an obstacle's cell to the robot's centre.
  [[nodiscard]] double inflation_m() const;

  CostMapParams params_;
  std::optional<Polygon> bound_;
  std::vector<Polygon> keep_out_;
  Grid<CellState> states_;
  Grid<float> clearance_;
  Grid<float> costs_;
};

}  // namespace seeker::nav
