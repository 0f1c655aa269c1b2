/// \file
/// Lengths of ways between places of the known floor, roughly: for planning several drives ahead.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "common/core/grid.hpp"

namespace seeker::explore {

/// On the coarse cells of FloorView::reachable, which must outlive it.
class CoarseWays {
 public:
  explicit CoarseWays(const Grid<std::uint8_t>& floor) : floor_(&floor) {}

  /// Way lengths in m from one place to each of the others; infinity where none is known.
  [[nodiscard]] std::vector<double> lengths_m(const Point2& from_map, const std::vector<Point2>& to_map) const;

  static constexpr double kNoWay = std::numeric_limits<double>::infinity();

 private:
  const Grid<std::uint8_t>* floor_;
};

}  // namespace seeker::explore
