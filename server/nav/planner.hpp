/// \file
/// Paths through a cost map: to one goal by A*, to all goals by one Dijkstra, and the floor that can be reached.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/result.hpp"
#include "server/nav/cost_map.hpp"

namespace seeker::nav {

/// A path in the frame `map`. The first waypoint is where the robot stands; consecutive ones are joined by straight
/// lines.
struct Path {
  std::vector<Point2> waypoints;
  double length_m = 0.0;
  double cost = 0.0;  ///< length weighted by CostMap::cost, >= length_m

  [[nodiscard]] bool empty() const { return waypoints.empty(); }
};

struct PlannerParams {
  double start_snap_m =
      0.6;  ///< a start inside inflated space, or on floor that leads nowhere, is left by departure_cell()
  double goal_snap_m = 0.3;  ///< a goal that cannot be entered is moved to the nearest traversable cell within this
  bool shorten = true;       ///< any-angle: drop waypoints where the straight segment is clear and not costlier
};

/// Cheapest 8-connected path (A*), then shortened by line of sight. kUnreachable: the sentence says whether the start,
/// the goal or the connection is the cause.
[[nodiscard]] Result<Path> plan(const CostMap& map, const Point2& start_map, const Point2& goal_map,
                                const PlannerParams& params = {});

/// Returns why plan() finds no path between these places; for use after it has failed.
[[nodiscard]] UnreachableCause cause_of_no_path(const CostMap& map, const Point2& start_map, const Point2& goal_map,
                                                const PlannerParams& params = {});

/// Travel cost from one place to every cell, so that coverage can compare many candidate goals for one search.
class DistanceField {
 public:
  /// One Dijkstra over the whole map. kUnreachable: no traversable cell within start_snap_m of the start.
  [[nodiscard]] static Result<DistanceField> build(const CostMap& map, const Point2& start_map,
                                                   const PlannerParams& params = {});

  /// Cost to reach the goal (metres weighted by CostMap::cost); nothing where no path leads. The goal is not moved.
  [[nodiscard]] std::optional<double> cost_to(const Point2& goal_map) const;
  [[nodiscard]] std::optional<double> cost_to(CellIndex cell) const;
  /// The reached cell with the lowest cost within `radius_m` of the goal, of those whose middle `fits` if given.
  [[nodiscard]] std::optional<CellIndex> cheapest_near(const Point2& goal_map, double radius_m,
                                                       const std::function<bool(const Point2&)>& fits = nullptr) const;
  /// The path itself, shortened if `shorten`; `map` must be the one the field was built from. The goal may be off by
  /// goal_snap_m. kUnreachable as for plan().
  [[nodiscard]] Result<Path> path_to(const CostMap& map, const Point2& goal_map) const;
  [[nodiscard]] const Grid<float>& costs() const { return costs_; }

 private:
  DistanceField() = default;
  PlannerParams params_;
  Point2 start_ = Point2::Zero();
  Grid<float> costs_;          ///< infinity where no path leads
  Grid<std::uint8_t> parent_;  ///< direction 0..7 to the predecessor
};

/// Cells at `resolution_m` that the robot's centre can reach from `start_map` (1) or not (0): the traversable floor
/// connected to the start, a coarse cell counting when at least half of it is. Cell borders lie on multiples of
/// `resolution_m`, so that grids of different calls line up. kUnreachable: the start is walled in.
[[nodiscard]] Result<Grid<std::uint8_t>> reachable_floor(const CostMap& map, const Point2& start_map,
                                                         double resolution_m, const PlannerParams& params = {});

}  // namespace seeker::nav
