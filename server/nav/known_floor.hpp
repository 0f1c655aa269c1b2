/// \file
/// Floor that the robot could reach at some time, as it saw it from near.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/grid.hpp"
#include "common/core/line_map.hpp"
#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"
#include "server/nav/floor_view.hpp"

namespace seeker::nav {

/// Whether the robot has seen the place itself, not only others of its fleet.
[[nodiscard]] bool seen_by_itself(const FloorView& view, const Point2& p_map);

/// Whether what is occupied at the place is taken for a mapped wall: a segment runs there that is longer than people
/// are wide.
[[nodiscard]] bool on_wall(const Point2& p_map, const std::vector<MapSegment>& segments);

/// Something that stands where the floor was free.
struct StandingThing {
  Point2 p_map = Point2::Zero();  ///< its first cell
  std::vector<CellIndex> cells;   ///< of it, of the occupancy, as far as they lie on that floor
};

/// Union of the reachable floor of many floor views; their cells lie on multiples of their size, so that they line up.
class KnownFloor {
 public:
  /// Takes what lies within `near_m` of the robot: from afar a wall seen flat is a row of dots, and the floor seems to
  /// go on between them up to the wall itself. What only other robots have seen is not remembered: it lies as well as
  /// the maps lie upon each other.
  void add(const FloorView& view, const Point2& robot_map, double near_m);
  [[nodiscard]] bool contains(const Point2& p_map) const;
  /// Whether a way led there at some time, from however far it was seen: then somebody is in the way where none does.
  [[nodiscard]] bool was_reachable(const Point2& p_map) const;
  /// What stands now on floor that the robot could reach, and is no mapped wall: people. Walls show up there when the
  /// robot was a little off as it saw the floor.
  [[nodiscard]] std::vector<StandingThing> occupied_now(const FloorView& view,
                                                        const std::vector<MapSegment>& segments) const;
  /// Of the last grid added.
  [[nodiscard]] double present_area_m2() const { return present_m2_; }
  /// The map moved: takes every cell to the one its place lies in now.
  void transform(const MapMove& move);

 private:
  Grid<std::uint8_t> floor_;
  Grid<std::uint8_t> from_afar_;  ///< and what was seen from farther away
  double present_m2_ = 0.0;
};

}  // namespace seeker::nav
