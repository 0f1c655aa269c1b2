/// \file
/// Heading change -> velocity command (spec S3.2, "Drive").
#pragma once

#include "common/core/pose2.hpp"

namespace seeker::search {

struct DriveLawParams {
  double max_v_m_s = 0.2;
  double max_omega_rad_s = 0.6;
  double rotation_time_s = 1.0;   ///< omega = u* / rotation_time_s
  double stop_distance_m = 0.35;  ///< no forward motion at or below this front distance
  double slow_span_m = 0.65;      ///< full speed from stop_distance + slow_span
};

/// omega = clamp(u*/1 s, +-0.6), v = 0.2 clamp((F - 0.35)/0.65, 0, 1) max(0, cos u*).
[[nodiscard]] Twist2 drive_command(double heading_change_rad, double front_m, const DriveLawParams& params = {});

}  // namespace seeker::search
