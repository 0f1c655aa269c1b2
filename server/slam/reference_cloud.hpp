/// \file
/// The points against which a scan is matched, with fast look-ups.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "common/core/grid.hpp"
#include "server/slam/oriented_points.hpp"

namespace seeker::slam {

/// Immutable set of oriented points in the frame `map`: nearest neighbour by kd-tree, coarse presence by grid.
class ReferenceCloud {
 public:
  explicit ReferenceCloud(std::vector<OrientedPoint> points_map);
  ReferenceCloud(const ReferenceCloud&) = delete;
  ReferenceCloud& operator=(const ReferenceCloud&) = delete;
  ~ReferenceCloud();

  /// The nearest point within `radius_m`; null when there is none.
  [[nodiscard]] const OrientedPoint* nearest(const Point2& p_map, double radius_m) const;
  /// True when a point lies in the coarse cell of p or beside it (within 0.1 to 0.2 m).
  [[nodiscard]] bool has_near(const Point2& p_map) const {
    const CellIndex cell = presence_.frame().cell_of(p_map);
    return presence_.contains(cell) && presence_[cell] != 0;
  }
  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] const std::vector<OrientedPoint>& points() const { return points_; }

 private:
  struct Tree;
  std::vector<OrientedPoint> points_;
  std::unique_ptr<Tree> tree_;
  Grid<std::uint8_t> presence_;
};

}  // namespace seeker::slam
