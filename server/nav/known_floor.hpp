/// \file
/// Memory of the floor that the robot could reach at some time, as observed from nearby.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/line_map.hpp"
#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"
#include "server/nav/floor_view.hpp"

namespace seeker::nav {

/// Whether the robot has observed the place itself, and not only other robots of its fleet.
[[nodiscard]] bool seen_by_itself(const FloorView& view, const Point2& p_map);

/// Whether an occupied place belongs to a mapped wall: a segment of the line map that is longer than people are wide
/// runs there.
[[nodiscard]] bool on_wall(const Point2& p_map, const std::vector<MapSegment>& segments);

/// An object that stands now where the floor was free before.
struct StandingObject {
  Point2 p_map = Point2::Zero();  ///< centre of its first cell
  std::vector<CellIndex> cells;   ///< its cells of the occupancy grid that lie on the remembered floor
};

/// Union of the reachable floor of many floor snapshots. Their cells lie on multiples of the cell size, so that they
/// line up.
class KnownFloor {
 public:
  /// Adds the reachable floor within `near_m` of the robot. From farther away a wall seen at a flat angle is a row of
  /// dots, and the floor seems to extend between them up to the wall itself. Floor that only other robots have observed
  /// is not remembered, because its place is only as accurate as the alignment of the maps.
  void add(const FloorView& view, const Point2& robot_map, double near_m);
  [[nodiscard]] bool contains(const Point2& p_map) const;
  /// Whether a path led to the place at some time, from any distance at which it was observed: if none leads there now,
  /// somebody blocks it.
  [[nodiscard]] bool was_reachable(const Point2& p_map) const;
  /// Objects that stand now on floor that the robot could reach and that belong to no mapped wall: people. Mapped walls
  /// are excluded because they appear on that floor when the robot's pose was inaccurate as it observed the floor.
  [[nodiscard]] std::vector<StandingObject> occupied_now(const FloorView& view,
                                                         const std::vector<MapSegment>& segments) const;
  /// Area of the reachable floor of the last snapshot that was added, in square metres.
  [[nodiscard]] double present_area_m2() const { return present_m2_; }
  /// The map was corrected: every cell moves to the cell that contains its corrected place.
  void transform(const MapMove& move);

 private:
  Grid<std::uint8_t> floor_;
  Grid<std::uint8_t> from_afar_;  ///< floor that was observed from farther away than `near_m`
  double present_m2_ = 0.0;
};

}  // namespace seeker::nav
