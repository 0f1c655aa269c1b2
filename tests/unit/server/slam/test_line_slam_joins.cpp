// What line SLAM carries from one local map into the next.
#include <cmath>

#include <gtest/gtest.h>

#include "ring_trip.hpp"
#include "rooms.hpp"
#include "server/slam/line_slam.hpp"

namespace seeker::slam {
namespace {

constexpr double kShort_m = 3.0;

/// Until the next local map has begun: the scan that began it is the last one.
void drive_over_a_join(Trip& trip, LineSlam& slam) {
  const std::size_t before = slam.local_maps();
  while (slam.local_maps() == before) {
    trip.step();
    ASSERT_TRUE(trip.feed(slam));
    ASSERT_LT(trip.path_m(), 40.0) << "no local map is ever full";
  }
}

class Joins : public ::testing::TestWithParam<PointUse> {};

INSTANTIATE_TEST_SUITE_P(LineSlam, Joins, ::testing::Values(PointUse::kNone, PointUse::kLeftover, PointUse::kAll));

// A filter that begins with an uncertain heading gains certainty from walls that hold no information about it.
TEST_P(Joins, ALocalMapKnowsExactlyWhereItsFirstScanWasTaken) {
  Trip trip(15);
  LineSlamParams params;
  params.local.max_distance_m = kShort_m;
  params.points.use = GetParam();
  LineSlam slam(params, trip.truth());
  for (int k = 0; k < 3; ++k) {
    ASSERT_NO_FATAL_FAILURE(drive_over_a_join(trip, slam));
    EXPECT_FALSE(slam.local_map().segments().empty()) << "its first scan is the one that it begins with";
    EXPECT_EQ(slam.local_map().robot(), Pose2{});
    EXPECT_LT(slam.local_map().robot_covariance().trace(), 1e-9);
    EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.2);
  }
}

TEST(LineSlam, TheJointHoldsWhatTheWheelsMayBeOffBeforeTheFirstScan) {
  Trip trip(16);
  LineSlamParams params;
  params.local.max_distance_m = kShort_m;
  params.local.joint_sigma_m = 0.0;
  params.local.joint_sigma_rad = 0.0;
  params.points.use = PointUse::kNone;
  params.odometry_bias = kCalibratedOdometry;
  params.odometry_scale.max = 1.0;
  LineSlam slam(params, trip.truth());
  Matrix3 before = Matrix3::Zero();
  while (slam.local_maps() == 1) {
    before = slam.estimate().covariance;
    trip.step();
    ASSERT_TRUE(trip.feed(slam));
  }
  const double path_m = 0.5 * Trip::kTick_s;
  const double wheels_rad = params.odometry.theta_sigma_rad_per_sqrt_m * std::sqrt(path_m);
  EXPECT_GT(slam.estimate().covariance(2, 2), before(2, 2) + 0.9 * wheels_rad * wheels_rad);
}

}  // namespace
}  // namespace seeker::slam
