#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "common/core/angle.hpp"
#include "ring_trip.hpp"
#include "rooms.hpp"
#include "server/slam/line_slam.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::slam {
namespace {

using testing::Pose2Near;

bool is_positive_definite(const Matrix3& m) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(m);
  return m.isApprox(m.transpose(), 1e-9) && eigen.eigenvalues()[0] > 0.0;
}

TEST(LineSlam, ClosesTheLoopOfARing) {
  Trip trip(3);
  LineSlam slam({}, trip.truth());
  double worst_m = 0.0;
  for (int round = 0; round < 26; ++round) {  // 104 m: two rounds
    ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 4.0));
    worst_m = std::max(worst_m, distance_m(slam.estimate().map_T_base, trip.truth()));
  }
  EXPECT_GT(slam.loops().closed, 0);
  EXPECT_GT(slam.estimate().map_epoch, 0U);
  EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.1);
  EXPECT_LT(worst_m, 0.35) << "before the loop was closed";
  EXPECT_GT(distance_m(Pose2{3.0, 1.0, 0.0} * trip.odom(), trip.truth()), 2.0) << "the wheels alone";
}

TEST(LineSlam, MapsEachWallOnce) {
  Trip trip(4);
  LineSlam slam({}, trip.truth());
  ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 110.0));
  const std::vector<MapSegment> segments = slam.segments();
  double mapped_m = 0.0;
  double off_m = 0.0;
  for (const MapSegment& segment : segments) {
    mapped_m += segment.length_m;
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : ring()) {
      const Point2 along = (b - a).normalized();
      const Point2 from_a = segment.map_T_segment.translation() - a;
      const double s = std::clamp(from_a.dot(along), 0.0, (b - a).norm());
      nearest_m = std::min(nearest_m, (from_a - s * along).norm());
    }
    off_m += segment.length_m * nearest_m;
  }
  EXPECT_LT(off_m / mapped_m, 0.05) << "mean distance of mapped walls from true ones";
  const double walls_m = 56.0 + 40.0;  // outer and inner walls
  EXPECT_GT(mapped_m, 0.85 * walls_m);
  EXPECT_LT(mapped_m, 1.3 * walls_m) << "two rounds must not map the walls twice";
}

TEST(LineSlam, TypedFaultsLeaveTheEstimateUsable) {
  Trip trip(5);
  LineSlam slam({}, trip.truth());
  ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 3.0));
  LaserScan scan = trip.scan();
  EXPECT_EQ(slam.predict({NAN, 0.0, 0.0}, trip.time()).error().code, Errc::kInvalidArgument);
  scan.ranges_m[3] = NAN;
  EXPECT_EQ(slam.update(scan).error().code, Errc::kInvalidArgument);
  scan.ranges_m.assign(361, kNoReturn);
  EXPECT_EQ(slam.update(scan).error().code, Errc::kNotReady) << "all out of range";
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kDegraded);
  EXPECT_EQ(slam.update(scan).error().code, Errc::kInvalidArgument) << "the same stamp again";
  trip.step();
  ASSERT_TRUE(trip.feed(slam));
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised);
  EXPECT_TRUE(is_positive_definite(slam.estimate().covariance));
  EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.1);
}

TEST(LineSlam, ReportsALaserThatRepeatsItself) {
  Trip trip(6);
  LineSlam slam({}, trip.truth());
  ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 2.0));
  LaserScan frozen = trip.scan();
  Status last;
  for (int k = 0; k < 8; ++k) {
    trip.step();
    ASSERT_TRUE(slam.predict(trip.odom(), trip.time()));
    frozen.stamp = trip.time();
    last = slam.update(frozen);
  }
  ASSERT_FALSE(last);
  EXPECT_EQ(last.error().code, Errc::kInvalidArgument);
  EXPECT_NE(last.error().message.find("repeats"), std::string::npos);
}

TEST(LineSlam, AJumpOfTheOdometryIsPutRight) {
  Trip trip(7);
  LineSlam slam({}, trip.truth());
  ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 3.0));
  trip.step();
  EXPECT_FALSE(slam.predict(trip.odom() * Pose2{5.0, 0.0, 0.0}, trip.time()));
  ASSERT_TRUE(slam.update(trip.scan()));
  EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.15);
}

TEST(LineSlam, AJumpOfTheOdometryIsAGapInWhichTheRobotMayHaveGoneAnywhere) {
  Rng rng(14);
  Pose2 truth{2.0, 3.0, 0.0};
  Pose2 odom;
  LineSlam slam({}, truth);
  for (int k = 0; k < 4; ++k) {
    ASSERT_TRUE(slam.predict(odom, robot_time_s(k)));
    ASSERT_TRUE(slam.update(scan_at(furnished_room(), truth, k, rng)));
    truth = truth * Pose2{0.2, 0.0, 0.0};
    odom = odom * Pose2{0.2, 0.0, 0.0};
  }
  truth = truth * Pose2{0.7, 0.5, 0.3};
  EXPECT_FALSE(slam.predict(odom * Pose2{20.0, 0.0, 0.0}, robot_time_s(4.0)));
  ASSERT_TRUE(slam.update(scan_at(furnished_room(), truth, 4.0, rng)));
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  EXPECT_LT(distance_m(slam.estimate().map_T_base, truth), 0.05);
}

TEST(LineSlam, GapsOfAlmostAMetreBetweenScansAreBridged) {
  for (const std::uint64_t seed : {11U, 12U, 13U}) {
    Trip trip(seed);
    LineSlam slam({}, trip.truth());
    Pose2 last = trip.truth();
    ASSERT_TRUE(trip.feed(slam));
    while (trip.path_m() < 48.0) {
      trip.step();
      if (moved(last, trip.truth(), 0.8, 0.5)) {
        last = trip.truth();
        (void)trip.feed(slam);  // a scan that does not match is no reason to stop
      }
    }
    EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.3) << "seed " << seed;
  }
}

TEST(LineSlam, WheelsThatSlipByMoreThanAMetreInAGapAreFoundOut) {
  Rng rng(14);
  const Pose2 start{2.0, 3.0, 0.0};
  LineSlam slam({}, start);
  Pose2 truth = start;
  Pose2 odom;
  const Pose2 step{0.4, 0.0, 0.0};
  const Pose2 slip{-1.5, 0.9, 0.1};  // beyond the window of 1 m that is searched first
  for (int k = 0; k < 6; ++k) {
    ASSERT_TRUE(slam.predict(odom, robot_time_s(k)));
    ASSERT_TRUE(slam.update(scan_at(furnished_room(), truth, k, rng)));
    truth = truth * step;
    odom = odom * (k == 4 ? step * slip : step);
  }
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  EXPECT_LT(distance_m(slam.estimate().map_T_base, truth * inverse(step)), 0.05);
}

TEST(LineSlam, SaysDegradedInACorridorAndHoldsOnlyWhatItSees) {
  const std::vector<Wall> walls{{{-50.0, 0.0}, {50.0, 0.0}}, {{50.0, 2.0}, {-50.0, 2.0}}};
  Rng rng(8);
  LineSlam slam({}, {0.0, 1.0, 0.0});
  double x_m = 0.0;
  for (int k = 0; k < 40; ++k, x_m += 0.1) {
    ASSERT_TRUE(slam.predict({x_m, 0.0, 0.0}, robot_time_s(0.1 * k)));
    (void)slam.update(scan_at(walls, {x_m, 1.0, 0.0}, 0.1 * k, rng, kPi, 8.0));
  }
  const PoseEstimate estimate = slam.estimate();
  EXPECT_EQ(estimate.quality, LocalisationQuality::kDegraded);
  EXPECT_NE(estimate.cause.find("corridor"), std::string::npos);
  EXPECT_GT(estimate.covariance(0, 0), 4.0 * estimate.covariance(1, 1)) << "along against across";
}

/// How far the heading is off after 60 m of a straight corridor, with a scanner that sits turned by 1.1 degrees.
double heading_error_rad(const LineSlamParams& params) {
  const std::vector<Wall> walls{{{-20.0, 0.0}, {100.0, 0.0}}, {{100.0, 2.0}, {-20.0, 2.0}}};
  const Pose2 base_T_true_laser{0.0, 0.0, 0.02};
  Rng rng(9);
  Pose2 truth{0.0, 1.0, 0.0};
  LineSlam slam(params, truth * base_T_true_laser);
  for (int k = 0; k < 240; ++k) {
    EXPECT_TRUE(slam.predict(truth, robot_time_s(k)));
    (void)slam.update(scan_at(walls, truth * base_T_true_laser, k, rng, kPi, 8.0));
    truth.x_m += 0.25;
  }
  return std::abs(wrap_angle(slam.estimate().map_T_base.theta_rad - base_T_true_laser.theta_rad));
}

TEST(LineSlam, AScannerThatIsMountedRotatedDoesNotDistortACorridor) {
  LineSlamParams unlearnt;
  unlearnt.odometry_bias = kCalibratedOdometry;
  const double learnt_rad = heading_error_rad({});
  EXPECT_LT(learnt_rad, 0.05);
  EXPECT_GT(heading_error_rad(unlearnt), 2.0 * learnt_rad) << "what the robot learns makes the difference";
}

TEST(LineSlam, FindsTheRobotInALoadedMapWithoutAHint) {
  Trip first(9);
  LineSlam mapper({}, first.truth());
  ASSERT_NO_FATAL_FAILURE(drive(first, mapper, 60.0));
  const LineMap map = mapper.map();
  ASSERT_TRUE(validate(map));

  Trip second(10, {15.0, 3.0, 1.4});
  LineSlam slam;
  ASSERT_TRUE(slam.load(map, MapUse::kLocalise));
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kUnknown) << "never a pose that nobody measured";
  EXPECT_GT(slam.segments().size(), 10U) << "the loaded map can be looked at meanwhile";
  for (int metre = 0; metre < 10 && slam.estimate().quality == LocalisationQuality::kUnknown; ++metre) {
    ASSERT_NO_FATAL_FAILURE(drive(second, slam, 1.0));
  }
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  ASSERT_NO_FATAL_FAILURE(drive(second, slam, 15.0));
  EXPECT_LT(distance_m(slam.estimate().map_T_base, second.truth()), 0.2);
  EXPECT_EQ(slam.map().keyframes, map.keyframes) << "localising never writes the map";
  EXPECT_EQ(slam.map().nodes.size(), map.nodes.size());
}

TEST(LineSlam, AMapThatIsOnlyReadStandsStillHoweverLongTheRobotPatrols) {
  Trip first(9);
  LineSlam mapper({}, first.truth());
  ASSERT_NO_FATAL_FAILURE(drive(first, mapper, 60.0));
  const LineMap map = mapper.map();
  Trip second(10);
  LineSlam slam;
  ASSERT_TRUE(slam.load(map, MapUse::kLocalise));
  ASSERT_TRUE(slam.relocalise(second.truth()));
  ASSERT_NO_FATAL_FAILURE(drive(second, slam, 6.0));
  ASSERT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  const LineMap joined = slam.map();
  const std::vector<MapSegment> segments = slam.segments();
  for (int round = 0; round < 4; ++round) {
    ASSERT_NO_FATAL_FAILURE(drive(second, slam, 30.0));
    EXPECT_LT(distance_m(slam.estimate().map_T_base, second.truth()), 0.15);
    EXPECT_TRUE(is_positive_definite(slam.estimate().covariance));
    EXPECT_LE(slam.local_maps(), map.nodes.size() + 2U) << "of its own the robot keeps the newest two";
  }
  EXPECT_GT(slam.loops().closed, 10) << "what moved the map, were it not held";
  LineMap now = slam.map();
  now.next_id = joined.next_id;
  EXPECT_EQ(now.nodes, map.nodes) << "to the last bit";
  EXPECT_TRUE(now == joined) << "epoch, relations, walls and scans";
  EXPECT_EQ(slam.segments(), segments);
}

TEST(LineSlam, LooksForItsPlaceForEverWithoutGrowing) {
  Trip first(12);
  LineSlam mapper({}, first.truth());
  ASSERT_NO_FATAL_FAILURE(drive(first, mapper, 12.0));
  LineSlamParams params;
  params.relocalise.claim.witnesses = 1000;  // it never finds itself
  LineSlam slam(params);
  ASSERT_TRUE(slam.load(mapper.map(), MapUse::kLocalise));
  Trip second(13);
  ASSERT_NO_FATAL_FAILURE(drive(second, slam, 45.0));
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kLost);
  EXPECT_LE(slam.local_maps(), mapper.map().nodes.size() + 2U);
}

TEST(LineSlam, KeepsEveryWallOfALoadedMap) {
  Trip trip(9);
  LineSlam mapper({}, trip.truth());
  ASSERT_NO_FATAL_FAILURE(drive(trip, mapper, 25.0));
  const LineMap map = mapper.map();
  for (const MapUse use : {MapUse::kLocalise, MapUse::kContinue}) {
    LineSlam slam;
    ASSERT_TRUE(slam.load(map, use));
    EXPECT_EQ(slam.map().segments.size(), map.segments.size());
    ASSERT_TRUE(slam.relocalise(std::nullopt));
    EXPECT_EQ(slam.map().segments.size(), map.segments.size()) << "asked once more";
  }
}

TEST(LineSlam, ANamedPlaceGoesAlongWithTheRobot) {
  Trip first(9);
  LineSlam mapper({}, first.truth());
  ASSERT_NO_FATAL_FAILURE(drive(first, mapper, 60.0));
  Trip second(10, {5.0, 1.0, 0.0});
  LineSlam slam;
  ASSERT_TRUE(slam.load(mapper.map(), MapUse::kContinue));
  ASSERT_TRUE(slam.relocalise(second.truth()));
  for (const double end_m = second.path_m() + 3.0; second.path_m() < end_m; second.step()) {
    ASSERT_TRUE(slam.predict(second.odom(), second.time())) << "the laser says nothing";
  }
  ASSERT_NO_FATAL_FAILURE(drive(second, slam, 2.0));
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  EXPECT_LT(distance_m(slam.estimate().map_T_base, second.truth()), 0.3);
}

TEST(LineSlam, ClosesTheLoopWithAScanEachMetre) {
  Trip trip(3);
  LineSlam slam({}, trip.truth());
  for (double next_m = 0.0; trip.path_m() < 104.0; trip.step()) {
    ASSERT_TRUE(slam.predict(trip.odom(), trip.time()));
    if (trip.path_m() >= next_m) {
      (void)slam.update(trip.scan());
      next_m += 1.0;
    }
  }
  EXPECT_GT(slam.loops().closed, 0);
  EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.2);
}

TEST(LineSlam, ContinuesALoadedMap) {
  Trip trip(11);
  LineSlam mapper({}, trip.truth());
  ASSERT_NO_FATAL_FAILURE(drive(trip, mapper, 20.0));
  const LineMap map = mapper.map();
  LineSlam slam;
  ASSERT_TRUE(slam.load(map, MapUse::kContinue));
  ASSERT_TRUE(slam.relocalise(trip.truth()));
  ASSERT_NO_FATAL_FAILURE(drive(trip, slam, 30.0));
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kLocalised) << slam.estimate().cause;
  EXPECT_GT(slam.map().keyframes.size(), map.keyframes.size() + 20U);
  EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.3);
  EXPECT_TRUE(validate(slam.map()));
}

TEST(LineSlam, RefusesBeamsThatRunInTheOtherDirection) {
  Trip trip(17);
  LineSlam slam;
  Status taken;
  for (int k = 0; k < 2000 && taken; ++k) {
    trip.step();
    ASSERT_TRUE(slam.predict(trip.odom(), trip.time()));
    LaserScan scan = trip.scan();
    std::reverse(scan.ranges_m.begin(), scan.ranges_m.end());
    taken = slam.update(scan);
  }
  ASSERT_FALSE(taken);
  EXPECT_NE(taken.error().message.find("rotate against the wheels"), std::string::npos) << taken.error().message;
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kLost);
  slam.reset({});
  trip.step();
  EXPECT_TRUE(trip.feed(slam)) << "a new map begins";
}

TEST(LineSlam, IsLostInTheMapOfAnotherBuilding) {
  Trip trip(12);
  LineSlam mapper({}, trip.truth());
  ASSERT_NO_FATAL_FAILURE(drive(trip, mapper, 30.0));
  LineSlam slam;
  ASSERT_TRUE(slam.load(mapper.map(), MapUse::kLocalise));
  const std::vector<Wall> elsewhere = furnished_room();
  Rng rng(13);
  Pose2 truth{2.5, 2.2, 0.0};
  for (int k = 0; k < 400; ++k) {
    ASSERT_TRUE(slam.predict(truth, robot_time_s(0.1 * k)));
    ASSERT_TRUE(slam.update(scan_at(elsewhere, truth, 0.1 * k, rng)));
    ASSERT_NE(slam.estimate().quality, LocalisationQuality::kLocalised) << "step " << k;
    truth = truth * integrate({0.4, 0.28}, 0.1);
  }
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kLost);
  EXPECT_FALSE(slam.estimate().cause.empty());
}

TEST(LineSlam, RefusesAMapWithNothingToFind) {
  LineSlam slam;
  EXPECT_EQ(slam.load({}, MapUse::kLocalise).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(slam.relocalise(std::nullopt).error().code, Errc::kNotReady);
  EXPECT_EQ(slam.relocalise(Pose2{NAN, 0.0, 0.0}).error().code, Errc::kInvalidArgument);
}

}  // namespace
}  // namespace seeker::slam
