/// \file
/// Record of the robot's path and of its position uncertainty along it.
#pragma once

#include <cstddef>
#include <vector>

#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"

namespace seeker::explore {

struct TrailPoint {
  Point2 p_map = Point2::Zero();
  double sigma_m = 0.0;  ///< standard deviation of the position in its worst direction
};

/// Standard deviation of the position in its worst direction, from the covariance of (x, y, theta).
[[nodiscard]] double position_sigma_m(const Matrix3& covariance);

/// A trail of bounded size: when it is full every second place is dropped.
class Trail {
 public:
  void note(const Point2& p_map, double sigma_m);
  /// Path back along the trail to the place where the robot was most certain and then on to the start, in steps of a
  /// few metres.
  [[nodiscard]] std::vector<Point2> path_to_certainty() const;
  /// Places where the standard deviation was at most `sigma_m`.
  [[nodiscard]] std::vector<Point2> certain_places(double sigma_m) const;
  /// Drops all places after the one nearest to p, because the robot has returned to it.
  void cut_after(const Point2& p_map);
  void transform(const MapMove& move);

 private:
  std::vector<TrailPoint> points_;
};

}  // namespace seeker::explore
