/// \file
/// Approximate path lengths between places of the known floor, for planning several drives ahead.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "common/core/grid.hpp"

namespace seeker::explore {

/// Path lengths on the coarse cells of FloorView::reachable; the grid must outlive this object.
class CoarsePaths {
 public:
  explicit CoarsePaths(const Grid<std::uint8_t>& floor) : floor_(&floor) {}

  /// Path lengths in metres from one place to each of the others; infinity where no path is known.
  [[nodiscard]] std::vector<double> lengths_m(const Point2& from_map, const std::vector<Point2>& to_map) const;

  /// The same, with a guess where no path is known because a passage is narrower than a cell, or only another robot
  /// knows the floor between: half as long again as the straight line.
  [[nodiscard]] std::vector<double> expected_m(const Point2& from_map, const std::vector<Point2>& to_map) const;

  static constexpr double kNoPath = std::numeric_limits<double>::infinity();

 private:
  const Grid<std::uint8_t>* floor_;
};

}  // namespace seeker::explore
