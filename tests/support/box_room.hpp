/// \file
/// A room of four walls whose ranges are known exactly.
#pragma once

#include <algorithm>
#include <cmath>

#include "common/core/pose2.hpp"

namespace seeker::testing {

/// A rectangle around the origin of its frame `room`.
struct BoxRoom {
  double half_length_m = 3.0;  ///< along x
  double half_width_m = 2.0;   ///< along y

  /// Distance from a pose inside along its x axis to the wall.
  [[nodiscard]] double range_m(const Pose2& room_T_beam) const {
    const double c = std::cos(room_T_beam.theta_rad);
    const double s = std::sin(room_T_beam.theta_rad);
    const double to_end_m = (std::copysign(half_length_m, c) - room_T_beam.x_m) / c;
    const double to_side_m = (std::copysign(half_width_m, s) - room_T_beam.y_m) / s;
    return std::min(to_end_m, to_side_m);
  }
  /// Distance from a point to the nearest line of a wall.
  [[nodiscard]] double distance_from_walls_m(const Point2& p_room) const {
    return std::min(std::abs(half_length_m - std::abs(p_room.x())), std::abs(half_width_m - std::abs(p_room.y())));
  }
};

}  // namespace seeker::testing
