/// \file
/// Dense 2-D grids over the plane.
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>
#include <vector>

#include "common/core/assert.hpp"
#include "common/core/pose2.hpp"

namespace seeker {

/// Column i along x, row j along y.
struct CellIndex {
  int i = 0;
  int j = 0;

  friend auto operator<=>(const CellIndex&, const CellIndex&) = default;
};

/// Where a grid lies: cell (i, j) covers [origin + (i, j) * resolution, origin + (i+1, j+1) * resolution).
/// Row 0 is at the lowest y (the opposite of an image).
struct GridFrame {
  Point2 origin = Point2::Zero();  ///< lower-left corner of cell (0, 0), in the frame `map`
  double resolution_m = 0.05;

  [[nodiscard]] CellIndex cell_of(const Point2& p) const {
    return {static_cast<int>(std::floor((p.x() - origin.x()) / resolution_m)),
            static_cast<int>(std::floor((p.y() - origin.y()) / resolution_m))};
  }
  [[nodiscard]] Point2 centre_of(CellIndex c) const { return origin + resolution_m * Point2(c.i + 0.5, c.j + 0.5); }
  friend bool operator==(const GridFrame& a, const GridFrame& b) {
    return a.origin == b.origin && a.resolution_m == b.resolution_m;
  }
};

/// Rectangular grid of T with its frame; storage index = j * width + i.
template <class T>
class Grid {
 public:
  Grid() = default;
  Grid(const GridFrame& frame, int width, int height, T fill = T())
      : frame_(frame),
        width_(width),
        height_(height),
        cells_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {
    SEEKER_ASSERT(width >= 0 && height >= 0);
  }

  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] bool empty() const { return cells_.empty(); }
  [[nodiscard]] bool contains(CellIndex c) const { return c.i >= 0 && c.j >= 0 && c.i < width_ && c.j < height_; }
  [[nodiscard]] std::size_t index(CellIndex c) const {
    SEEKER_ASSERT(contains(c));
    return static_cast<std::size_t>(c.j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(c.i);
  }
  [[nodiscard]] CellIndex cell(std::size_t index) const {
    const auto width = static_cast<std::size_t>(width_);
    return {static_cast<int>(index % width), static_cast<int>(index / width)};
  }
  [[nodiscard]] typename std::vector<T>::reference operator[](CellIndex c) { return cells_[index(c)]; }
  [[nodiscard]] typename std::vector<T>::const_reference operator[](CellIndex c) const { return cells_[index(c)]; }
  [[nodiscard]] const std::vector<T>& cells() const { return cells_; }
  [[nodiscard]] std::vector<T>& cells() { return cells_; }

  friend bool operator==(const Grid&, const Grid&) = default;

 private:
  GridFrame frame_;
  int width_ = 0;
  int height_ = 0;
  std::vector<T> cells_;
};

}  // namespace seeker
