/// \file
/// Floor that the robot could reach at some time.
#pragma once

#include <cstdint>
#include <vector>

#include "common/core/grid.hpp"
#include "server/nav/floor_view.hpp"

namespace seeker::explore {

/// Whether the robot has seen the place itself, not only others of its fleet.
[[nodiscard]] bool seen_by_itself(const nav::FloorView& view, const Point2& p_map);

/// Union of the reachable floor of many floor views; their cells lie on multiples of their size, so that they line up.
class KnownFloor {
 public:
  /// Of a view; what only other robots have seen is not remembered: it lies as well as the maps lie upon each other.
  void add(const nav::FloorView& view);
  [[nodiscard]] bool contains(const Point2& p_map) const;
  /// Places where something stands now on floor that the robot could reach: people, or a door that was closed. Walls
  /// never show up there, since the robot's centre keeps its radius from them.
  [[nodiscard]] std::vector<Point2> occupied_now(const nav::FloorView& view) const;
  /// Of the last grid added.
  [[nodiscard]] double present_area_m2() const { return present_m2_; }
  /// The map moved: what was known no longer lies on cells.
  void clear();

 private:
  Grid<std::uint8_t> floor_;
  double present_m2_ = 0.0;
};

}  // namespace seeker::explore
