/// \file
/// Exact traversal of a grid by a straight line (Amanatides and Woo 1987).
#pragma once

#include <cmath>
#include <cstdlib>
#include <limits>

#include "common/core/grid.hpp"

namespace seeker::nav {

/// Walks the cells that the segment from -> to crosses, in order, both ends included. Coordinates are in cells.
class RayWalk {
 public:
  RayWalk(const Point2& from_cells, const Point2& to_cells)
      : cell_{static_cast<int>(std::floor(from_cells.x())), static_cast<int>(std::floor(from_cells.y()))} {
    const CellIndex last{static_cast<int>(std::floor(to_cells.x())), static_cast<int>(std::floor(to_cells.y()))};
    steps_left_ = std::abs(last.i - cell_.i) + std::abs(last.j - cell_.j);
    const Point2 delta = to_cells - from_cells;
    start_axis(delta.x(), from_cells.x(), cell_.i, step_i_, next_i_, delta_i_);
    start_axis(delta.y(), from_cells.y(), cell_.j, step_j_, next_j_, delta_j_);
    left_i_ = std::abs(last.i - cell_.i);
    left_j_ = std::abs(last.j - cell_.j);
  }

  [[nodiscard]] CellIndex cell() const { return cell_; }
  [[nodiscard]] int steps_left() const { return steps_left_; }
  /// Moves on to the next cell, across a side; false when the last cell was reached before.
  bool advance() {
    if (steps_left_ == 0) {
      return false;
    }
    --steps_left_;
    // Counting the steps left per axis makes the walk end in the right cell despite rounding.
    if (left_j_ == 0 || (left_i_ > 0 && next_i_ < next_j_)) {
      cell_.i += step_i_;
      next_i_ += delta_i_;
      --left_i_;
    } else {
      cell_.j += step_j_;
      next_j_ += delta_j_;
      --left_j_;
    }
    return true;
  }

 private:
  static void start_axis(double delta, double from, int cell, int& step, double& next, double& increment) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    step = delta > 0.0 ? 1 : -1;
    increment = delta != 0.0 ? std::abs(1.0 / delta) : kNever;
    const double to_border = delta > 0.0 ? cell + 1.0 - from : from - cell;
    next = delta != 0.0 ? to_border * increment : kNever;
  }

  CellIndex cell_;
  int steps_left_ = 0;
  int left_i_ = 0;
  int left_j_ = 0;
  int step_i_ = 1;
  int step_j_ = 1;
  double next_i_ = 0.0;
  double next_j_ = 0.0;
  double delta_i_ = 0.0;
  double delta_j_ = 0.0;
};

}  // namespace seeker::nav
