#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "ring_trip.hpp"
#include "rooms.hpp"
#include "server/slam/line_slam.hpp"

namespace seeker::slam {
namespace {

/// A robot in a corner of the ring that has looked once and turned to and fro.
struct Stand {
  Stand() : trip(11), slam({}, trip.truth()) {
    EXPECT_TRUE(trip.feed(slam));
    trip.move({0.0, 0.0, 0.05});
    EXPECT_TRUE(trip.feed(slam));
  }

  /// Of the direction of the wall that was seen first.
  [[nodiscard]] double sigma_rad() const {
    return std::sqrt(slam.local_map().segment_covariance(slam.local_map().segments().front().id)(1, 1));
  }
  /// Another scan without any motion; `frozen`: the very same one.
  void look(std::optional<LaserScan> frozen = std::nullopt) {
    time_s += Trip::kTick_s;
    LaserScan scan = frozen ? *std::move(frozen) : trip.scan();
    scan.stamp = trip.time() + seconds(time_s);
    ASSERT_TRUE(slam.predict(trip.odom(), scan.stamp));
    ASSERT_TRUE(slam.update(scan));
  }

  Trip trip;
  LineSlam slam;
  double time_s = 0.0;
};

TEST(LineSlamStanding, AStandMakesTheDirectionsOfWallsBetterForAWhile) {
  Stand stand;
  const int limit = LineSlamParams{}.stand_scans;
  const double before_rad = stand.sigma_rad();
  for (int k = 0; k < limit; ++k) {
    ASSERT_NO_FATAL_FAILURE(stand.look());
  }
  const double after_rad = stand.sigma_rad();
  EXPECT_LT(after_rad, 0.5 * before_rad) << "thirty scans hold more information than two";
  EXPECT_EQ(stand.slam.counts().stood, static_cast<std::uint64_t>(limit));
  for (int k = 0; k < limit; ++k) {
    ASSERT_NO_FATAL_FAILURE(stand.look());
  }
  EXPECT_EQ(stand.sigma_rad(), after_rad) << "what does not change is no noise: it must not be averaged for ever";
}

TEST(LineSlamStanding, WithAnObservationPeriodOnlyAStopOrItsEndMakesAnObservation) {
  Trip trip(12);
  LineSlamParams params;
  params.observation_period_s = 4.0;
  params.stand_scans = 0;
  params.points.use = PointUse::kOff;
  LineSlam slam(params, trip.truth());
  ASSERT_TRUE(trip.feed(slam));
  EXPECT_EQ(slam.local_map().scans(), 1U);
  for (int tick = 0; tick < 20; ++tick) {
    trip.step();
    ASSERT_TRUE(trip.feed(slam));
  }
  EXPECT_EQ(slam.local_map().scans(), 1U) << "2 s of driving";
  for (int tick = 1; tick <= 3; ++tick) {
    LaserScan scan = trip.scan();
    scan.stamp = trip.time() + seconds(0.1 * tick);
    ASSERT_TRUE(slam.predict(trip.odom(), scan.stamp));
    ASSERT_TRUE(slam.update(scan));
  }
  EXPECT_EQ(slam.local_map().scans(), 2U) << "one for the stop";
  EXPECT_LT(distance_m(slam.estimate().map_T_base, trip.truth()), 0.05) << "by lines alone";
  for (int tick = 0; tick < 3; ++tick) {  // the time that the stop took
    trip.move({});
  }
  for (int tick = 0; tick < 45; ++tick) {
    trip.step();
    ASSERT_TRUE(trip.feed(slam));
  }
  EXPECT_EQ(slam.local_map().scans(), 3U) << "more than 4 s of driving";
}

TEST(LineSlamStanding, AStandInACorridorIsOneToo) {
  const std::vector<Wall> walls{{{-50.0, 0.0}, {50.0, 0.0}}, {{50.0, 2.0}, {-50.0, 2.0}}};
  Rng rng(8);
  LineSlam slam({}, {0.0, 1.0, 0.0});
  constexpr int kDriven = 20;
  constexpr int kStood = 100;
  for (int k = 0; k < kDriven + kStood; ++k) {
    const Pose2 truth{0.1 * std::min(k, kDriven - 1), 1.0, 0.0};
    ASSERT_TRUE(slam.predict({truth.x_m, 0.0, 0.0}, robot_time_s(0.1 * k)));
    ASSERT_TRUE(slam.update(scan_at(walls, truth, 0.1 * k, rng, kPi, 8.0)));
  }
  EXPECT_EQ(slam.estimate().quality, LocalisationQuality::kDegraded) << slam.estimate().cause;
  EXPECT_GT(slam.counts().still, static_cast<std::uint64_t>(kStood / 2)) << "else each scan counts as a new one";
}

TEST(LineSlamStanding, AJumpOfTheOdometryIsOverWithTheNextScan) {
  Stand stand;
  ASSERT_NO_FATAL_FAILURE(stand.look());
  const Pose2 jumped = stand.trip.odom() * Pose2{5.0, 0.0, 0.0};
  const RobotTime now = stand.trip.time() + seconds(stand.time_s);
  EXPECT_FALSE(stand.slam.predict(jumped, now + seconds(0.1)));
  EXPECT_EQ(stand.slam.estimate().quality, LocalisationQuality::kDegraded);
  LaserScan scan = stand.trip.scan();
  scan.stamp = now + seconds(0.2);
  ASSERT_TRUE(stand.slam.update(scan));
  ASSERT_TRUE(stand.slam.predict(jumped, now + seconds(0.3)));
  EXPECT_EQ(stand.slam.estimate().quality, LocalisationQuality::kLocalised) << stand.slam.estimate().cause;
}

TEST(LineSlamStanding, AScanThatIsRepeatedGivesAStandingRobotNoInformation) {
  Stand stand;
  const LaserScan frozen = stand.trip.scan();
  ASSERT_NO_FATAL_FAILURE(stand.look(frozen));
  const double before_rad = stand.sigma_rad();
  for (int k = 0; k < 10; ++k) {
    ASSERT_NO_FATAL_FAILURE(stand.look(frozen));
  }
  EXPECT_EQ(stand.sigma_rad(), before_rad);
}

/// Along a corridor in which only posts too small for lines show how far the robot came, and a rotation to and fro
/// there.
double variance_along_a_corridor_m2(const PointNetParams& points) {
  std::vector<Wall> walls{{{-50.0, 0.0}, {50.0, 0.0}}, {{50.0, 2.0}, {-50.0, 2.0}}};
  for (const auto& post : {box(3.0, 0.0, 3.12, 0.12), box(4.5, 1.88, 4.62, 2.0), box(6.0, 0.0, 6.12, 0.12)}) {
    walls.insert(walls.end(), post.begin(), post.end());
  }
  LineSlamParams params;
  params.points = points;
  Rng rng(9);
  LineSlam slam(params, {0.0, 1.0, 0.0});
  Pose2 odom;
  for (int k = 0; k < 80; ++k) {
    EXPECT_TRUE(slam.predict(odom, robot_time_s(0.1 * k)));
    (void)slam.update(scan_at(walls, Pose2{0.0, 1.0, 0.0} * odom, 0.1 * k, rng, kPi, 8.0));
    odom = odom * (k < 30 ? Pose2{0.06, 0.0, 0.0} : Pose2{0.0, 0.0, k % 2 == 0 ? 0.03 : -0.03});
  }
  return slam.estimate().covariance(0, 0);
}

TEST(LineSlamStanding, MatchesFromOnePlaceAreNotCountedAsManyMeasurements) {
  PointNetParams always;
  always.leftover_m = 0.0;
  always.leftover_rad = 0.0;
  EXPECT_GT(variance_along_a_corridor_m2({}), 1.2 * variance_along_a_corridor_m2(always));
}

}  // namespace
}  // namespace seeker::slam
