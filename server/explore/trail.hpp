/// \file
/// Where the robot came along and how sure it was there.
#pragma once

#include <cstddef>
#include <vector>

#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"

namespace seeker::explore {

struct TrailPoint {
  Point2 p_map = Point2::Zero();
  double sigma_m = 0.0;  ///< of the position, in the worst direction
};

/// Standard deviation of the position in its worst direction, from the covariance of (x, y, theta).
[[nodiscard]] double position_sigma_m(const Matrix3& covariance);

/// Bounded: when it is full every second place goes.
class Trail {
 public:
  void note(const Point2& p_map, double sigma_m);
  /// Back along the trail by the place where the robot was most certain, and on to the start, should that not do, in
  /// steps of a few metres.
  [[nodiscard]] std::vector<Point2> way_to_certainty() const;
  /// Forgets everything after the place nearest to p: the robot went back to it.
  void cut_after(const Point2& p_map);
  void transform(const MapMove& move);

 private:
  std::vector<TrailPoint> points_;
};

}  // namespace seeker::explore
