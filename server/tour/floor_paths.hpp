/// \file
/// Shortest paths over a floor of cells in sixteen directions, for floors that are known as a whole.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "common/core/grid.hpp"

namespace seeker::tour {

/// Path lengths from one place over cells that are not 0. `floor` must outlive this object.
class FloorPaths {
 public:
  /// Computes them from the cell of `from`; up to the cell of `until` where it is given, beyond which lengths may be
  /// missing.
  FloorPaths(const Grid<std::uint8_t>& floor, const Point2& from, const Point2* until = nullptr);

  /// Path length in metres; infinity where no path leads.
  [[nodiscard]] double length_m(const Point2& to) const;
  /// The places of the path, both ends included; empty where no path leads.
  [[nodiscard]] std::vector<Point2> path_to(const Point2& to) const;

  static constexpr double kNoPath = std::numeric_limits<double>::infinity();

 private:
  void spread(CellIndex from, const CellIndex* until);
  [[nodiscard]] bool step_is_free(CellIndex from, CellIndex step) const;

  const Grid<std::uint8_t>* floor_;
  Grid<float> lengths_;         ///< in cells; infinity where no path leads
  Grid<std::uint8_t> came_by_;  ///< number of the step that led to the cell, kNoStep at the start
};

}  // namespace seeker::tour
