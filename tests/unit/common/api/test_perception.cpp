#include "common/api/perception.hpp"

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::api {
namespace {

using testing::Point2Near;
using testing::Pose2Near;

TEST(MovedDetection, GoesWithTheMapThatItBelongsTo) {
  Detection detection;
  detection.map_T_base = {1.0, 0.0, 0.0};
  detection.bearing_map_rad = kPi - 0.1;
  detection.position = Point2(3.0, 0.0);
  detection.position_covariance << 0.04, 0.0, 0.0, 0.01;
  const Detection there = moved(detection, {10.0, 5.0, kPi / 2.0});
  EXPECT_THAT(there.map_T_base, Pose2Near(Pose2{10.0, 6.0, kPi / 2.0}, 1e-12, 1e-12));
  EXPECT_NEAR(there.bearing_map_rad, -kPi / 2.0 - 0.1, 1e-12);
  EXPECT_THAT(*there.position, Point2Near(Point2(10.0, 8.0), 1e-12));
  EXPECT_NEAR(there.position_covariance(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(there.position_covariance(1, 1), 0.04, 1e-12);
}

TEST(MovedDetection, OfUnknownPlaceStaysSo) { EXPECT_FALSE(moved(Detection{}, {1.0, 2.0, 0.3}).position); }

}  // namespace
}  // namespace seeker::api
