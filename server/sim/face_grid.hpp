/// \file
/// Uniform grid over segments, which finds the segments that a ray can cross in the order of distance.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "common/core/pose2.hpp"

namespace seeker::sim {

/// A segment from a, with direction and length precomputed for the inner loop.
struct Segment {
  Point2 a = Point2::Zero();
  Point2 direction = Point2::UnitX();  ///< length 1
  double length_m = 0.0;

  [[nodiscard]] static Segment between(const Point2& a, const Point2& b) {
    const double length = (b - a).norm();
    return {a, (b - a) / length, length};
  }
  [[nodiscard]] Point2 b() const { return a + length_m * direction; }
};

/// Where a ray crosses a segment.
struct Crossing {
  double distance_m = 0.0;  ///< along the ray
  double along_m = 0.0;     ///< along the segment
  std::uint32_t face = 0;
};

class FaceGrid {
 public:
  FaceGrid() = default;
  FaceGrid(const Point2& min_corner, const Point2& max_corner, std::vector<Segment> segments);

  /// Calls `hit(const Crossing&)` for every crossing up to range_max_m, each once, cell by cell in the order of
  /// distance (unordered within a cell), and `cell_done()` after each cell; the latter returns true to end the walk.
  template <class Hit, class CellDone>
  void walk(const Point2& origin, const Point2& direction, double range_max_m, Hit&& hit, CellDone&& cell_done) const;

  /// Calls `visit(face)` for the segments with a part in the square of half side `reach_m` around p; a segment may be
  /// visited more than once.
  template <class Visit>
  void around(const Point2& p, double reach_m, Visit&& visit) const;

  [[nodiscard]] const std::vector<Segment>& segments() const { return segments_; }

 private:
  [[nodiscard]] int column(double x) const {
    return std::clamp(static_cast<int>((x - origin_.x()) * cells_per_m_), 0, columns_ - 1);
  }
  [[nodiscard]] int row(double y) const {
    return std::clamp(static_cast<int>((y - origin_.y()) * cells_per_m_), 0, rows_ - 1);
  }
  [[nodiscard]] std::span<const std::uint32_t> cell(int i, int j) const {
    const auto at = static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i);
    return {items_.data() + starts_[at], items_.data() + starts_[at + 1]};
  }
  [[nodiscard]] bool touches(const Segment& segment, int i, int j) const;

  std::vector<Segment> segments_;
  Point2 origin_ = Point2::Zero();
  double cell_m_ = 0.5;
  double cells_per_m_ = 2.0;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> starts_{0, 0};  ///< first item of each cell, row by row
  std::vector<std::uint32_t> items_;
};

/// One axis of a walk through the cells.
struct GridAxis {
  int step = 0;
  double next_m = std::numeric_limits<double>::infinity();   ///< distance at which the next cell border is met
  double pitch_m = std::numeric_limits<double>::infinity();  ///< distance between borders

  static GridAxis make(double origin, double direction, double low, double cell_m, int index) {
    GridAxis axis;
    if (direction > 0.0) {
      axis = {1, (low + (index + 1) * cell_m - origin) / direction, cell_m / direction};
    } else if (direction < 0.0) {
      axis = {-1, (low + index * cell_m - origin) / direction, -cell_m / direction};
    }
    return axis;
  }
};

template <class Hit, class CellDone>
void FaceGrid::walk(const Point2& origin, const Point2& direction, double range_max_m, Hit&& hit,
                    CellDone&& cell_done) const {
  int i = column(origin.x());
  int j = row(origin.y());
  GridAxis x = GridAxis::make(origin.x(), direction.x(), origin_.x(), cell_m_, i);
  GridAxis y = GridAxis::make(origin.y(), direction.y(), origin_.y(), cell_m_, j);
  double from_m = 0.0;
  while (from_m <= range_max_m) {
    const double to_m = std::min(x.next_m, y.next_m);
    for (const std::uint32_t index : cell(i, j)) {
      const Segment& s = segments_[index];
      const double determinant = direction.x() * s.direction.y() - direction.y() * s.direction.x();
      const Point2 offset = s.a - origin;
      const double distance = (offset.x() * s.direction.y() - offset.y() * s.direction.x()) / determinant;
      // A crossing belongs to the cell it lies in, so that each is reported once. Parallel lines give infinity or NaN.
      if (!(distance >= from_m && distance < to_m && distance <= range_max_m)) {
        continue;
      }
      const double along = (offset.x() * direction.y() - offset.y() * direction.x()) / determinant;
      if (along >= 0.0 && along <= s.length_m) {
        hit(Crossing{distance, along, index});
      }
    }
    if (cell_done()) {
      return;
    }
    GridAxis& axis = x.next_m < y.next_m ? x : y;
    int& position = x.next_m < y.next_m ? i : j;
    position += axis.step;
    if (axis.step == 0 || i < 0 || j < 0 || i >= columns_ || j >= rows_) {
      return;
    }
    from_m = std::max(from_m, to_m);
    axis.next_m += axis.pitch_m;
  }
}

template <class Visit>
void FaceGrid::around(const Point2& p, double reach_m, Visit&& visit) const {
  for (int j = row(p.y() - reach_m); j <= row(p.y() + reach_m); ++j) {
    for (int i = column(p.x() - reach_m); i <= column(p.x() + reach_m); ++i) {
      for (const std::uint32_t index : cell(i, j)) {
        visit(index);
      }
    }
  }
}

}  // namespace seeker::sim
