/// \file
/// Matchers shared by all tests.
#pragma once

#include <cmath>

#include <gmock/gmock.h>

#include "common/core/angle.hpp"
#include "common/core/pose2.hpp"

namespace seeker::testing {

// NOLINTNEXTLINE: gmock's macro defines the class
MATCHER_P3(Pose2Near, expected, tolerance_m, tolerance_rad, "") {
  const double dt = std::hypot(arg.x_m - expected.x_m, arg.y_m - expected.y_m);
  const double dr = std::abs(wrap_angle(arg.theta_rad - expected.theta_rad));
  *result_listener << "off by " << dt << " m and " << rad_to_deg(dr) << " deg";
  return dt <= tolerance_m && dr <= tolerance_rad;
}

// NOLINTNEXTLINE: gmock's macro defines the class
MATCHER_P2(Point2Near, expected, tolerance_m, "") {
  const double d = (arg - expected).norm();
  *result_listener << "off by " << d << " m";
  return d <= tolerance_m;
}

}  // namespace seeker::testing
