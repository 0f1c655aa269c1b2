#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "server/search/detection_tracker.hpp"
#include "server/search/target_range.hpp"
#include "server/vision/omni_camera.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::search {
namespace {

using seeker::testing::Point2Near;

vision::Sighting sighting_at(double bearing_rad, double score = 0.8) {
  vision::Sighting s;
  s.bearing_base_rad = bearing_rad;
  s.score = score;
  return s;
}

/// A scan whose beams all end on a circle of `range_m` about the target direction.
LaserScan scan_with(double bearing_rad, double range_m, double elsewhere_m) {
  LaserScan scan;
  scan.angle_min_rad = -kPi;
  scan.angle_step_rad = deg_to_rad(1.0);
  scan.range_max_m = 8.0;
  for (int k = 0; k < 360; ++k) {
    const double off = std::abs(wrap_angle(scan.angle_rad(static_cast<std::size_t>(k)) - bearing_rad));
    scan.ranges_m.push_back(static_cast<float>(off < deg_to_rad(5.0) ? range_m : elsewhere_m));
  }
  return scan;
}

SonarScan ring(double range_m) {
  SonarScan scan;
  scan.range_max_m = 5.0;
  scan.cone_half_angle_rad = deg_to_rad(15.0);
  for (const double heading_deg : {90.0, 50.0, 30.0, 10.0, -10.0, -30.0, -50.0, -90.0}) {
    const double h = deg_to_rad(heading_deg);
    scan.readings.push_back({{0.2 * std::cos(h), 0.2 * std::sin(h), h}, static_cast<float>(range_m)});
  }
  return scan;
}

/// A sweep over a box of side `side_m` turned by `turn_rad`, its middle straight ahead, and nothing else.
LaserScan scan_of_box(double middle_m, double side_m, double turn_rad) {
  LaserScan scan;
  scan.angle_min_rad = -kPi / 2.0;
  scan.angle_step_rad = deg_to_rad(0.5);
  scan.range_max_m = 8.0;
  const Pose2 base_T_box{middle_m, 0.0, turn_rad};
  for (int k = 0; k <= 360; ++k) {
    const double angle = scan.angle_rad(static_cast<std::size_t>(k));
    float range = kNoReturn;
    for (double r = 0.3; r < 4.0; r += 0.002) {
      const Point2 in_box = inverse(base_T_box) * Point2(r * std::cos(angle), r * std::sin(angle));
      if (in_box.cwiseAbs().maxCoeff() <= side_m / 2.0) {
        range = static_cast<float>(r);
        break;
      }
    }
    scan.ranges_m.push_back(range);
  }
  return scan;
}

TEST(Outline, PointsToTheMiddleOfABoxAtAnyTurn) {
  for (const double turn_deg : {0.0, 15.0, 30.0, 45.0, 70.0}) {
    const LaserScan scan = scan_of_box(1.0, 0.3, deg_to_rad(turn_deg));
    const double face_rad = deg_to_rad(5.0);  // a face beside the middle
    const auto range = lidar_range(scan, face_rad, {});
    ASSERT_TRUE(range) << turn_deg;
    const auto middle = outline_bearing(scan, face_rad, range->range_m, 0.3, {});
    ASSERT_TRUE(middle) << turn_deg;
    EXPECT_NEAR(rad_to_deg(*middle), 0.0, 1.5) << turn_deg;
  }
}

TEST(Outline, AWallIsNoOutlineOfATarget) {
  EXPECT_FALSE(outline_bearing(scan_of_box(3.0, 2.5, 0.0), 0.0, 1.75, 0.3, {}));
}

// R6 of the specification.
TEST(Bearing, PixelsOfThePaperGiveItsAngles) {
  const vision::OmniCamera camera;
  EXPECT_NEAR(rad_to_deg(camera.bearing_base_rad({123.0, 276.0})), 100.6, 0.05);
  EXPECT_NEAR(rad_to_deg(camera.bearing_base_rad({117.0, 263.0})), 96.6, 0.05);
}

TEST(Bearing, MapBearingFollowsEquation5) {
  for (const auto& [printed_deg, heading_deg, expected_deg] :
       {std::array{100.0, -41.0, 59.0}, std::array{97.0, -39.0, 58.0}}) {
    DetectionTracker tracker({{"thing"}}, {});
    Look look;
    look.map_T_base.theta_rad = deg_to_rad(heading_deg);
    look.sightings = {sighting_at(deg_to_rad(printed_deg))};
    ASSERT_EQ(tracker.add(look).size(), 1U);
    EXPECT_NEAR(rad_to_deg(tracker.detections()[0].bearing_map_rad), expected_deg, 1e-9);
  }
}

TEST(TargetRange, SonarInterpolatesAndEndsAtTheSides) {
  const DetectionParams params;
  const auto front = sonar_range(ring(1.0), 0.0, params);
  ASSERT_TRUE(front.has_value());
  EXPECT_NEAR(front->range_m, 1.2, 0.01);
  EXPECT_EQ(front->source, RangeSource::kSonar);
  EXPECT_TRUE(sonar_range(ring(1.0), deg_to_rad(70.0), params).has_value());
  EXPECT_TRUE(sonar_range(ring(1.0), deg_to_rad(92.0), params).has_value());
  EXPECT_FALSE(sonar_range(ring(1.0), deg_to_rad(130.0), params).has_value());
  EXPECT_FALSE(sonar_range(ring(kNoReturn), 0.0, params).has_value());
}

TEST(TargetRange, TheLastTransducerReachesThePapersOwnBearings) {
  for (const double bearing_deg : {100.0, 97.0, -100.0}) {
    EXPECT_TRUE(sonar_range(ring(1.0), deg_to_rad(bearing_deg), {}).has_value()) << bearing_deg;
  }
  EXPECT_FALSE(sonar_range(ring(1.0), deg_to_rad(106.0), {}).has_value());
}

TEST(TargetRange, EchoesAsPrintedLieOnACircleAboutTheRobot) {
  DetectionParams params;
  params.sonar_radius_m = 0.26;
  SonarScan scan = ring(1.0);
  scan.readings[3].range_m = 1.2F;  // +10 deg
  EXPECT_NEAR(sonar_range(scan, deg_to_rad(10.0), params)->range_m, 1.46, 1e-6);
  EXPECT_NEAR(sonar_range(scan, deg_to_rad(0.0), params)->range_m, 1.36, 1e-6) << "between +10 and -10 deg";
  EXPECT_NEAR(sonar_range(scan, deg_to_rad(100.0), params)->range_m, 1.26, 1e-6);
}

TEST(TargetRange, LidarComesFirstAndTheHintVetoes) {
  const DetectionParams params;
  const LaserScan laser = scan_with(0.5, 2.0, 5.0);
  const SonarScan sonar = ring(0.8);
  const auto range = range_in_direction(0.5, &laser, &sonar, std::nullopt, params);
  ASSERT_TRUE(range.has_value());
  EXPECT_EQ(range->source, RangeSource::kLidar);
  EXPECT_NEAR(range->range_m, 2.0, 1e-6);
  EXPECT_FALSE(range_in_direction(0.5, &laser, &sonar, 6.0, params).has_value());
  EXPECT_EQ(range_in_direction(0.5, &laser, &sonar, 1.0, params)->source, RangeSource::kSonar);
}

TEST(Triangulation, NeedsParallax) {
  const Point2 target(3.0, 0.5);
  std::vector<BearingRange> sightings;
  for (const Pose2& pose : {Pose2{0, 0, 0}, Pose2{0.05, 0, 0.1}}) {
    sightings.push_back({pose, bearing_to(pose, target), 0.02, {}, 0.1});
  }
  EXPECT_FALSE(estimate_position(sightings, deg_to_rad(10.0), 8.0).has_value());
  const Pose2 aside{0.0, 1.5, -0.2};
  sightings.push_back({aside, bearing_to(aside, target), 0.02, {}, 0.1});
  const auto p = estimate_position(sightings, deg_to_rad(10.0), 8.0);
  ASSERT_TRUE(p.has_value());
  EXPECT_THAT(p->p_map, Point2Near(target, 1e-6));
}

TEST(Triangulation, RefusesIntersectionsBehind) {
  std::vector<BearingRange> sightings{{{0, 0, 0}, 0.5, 0.02, {}, 0.1}, {{0, 1, 0}, 1.2, 0.02, {}, 0.1}};
  EXPECT_FALSE(estimate_position(sightings, deg_to_rad(10.0), 8.0).has_value());
}

TEST(Triangulation, ErrorIsWhatItsCovarianceSays) {
  Rng rng(81);
  constexpr int kRuns = 500;
  double nees = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const Point2 target(rng.uniform(1.5, 3.0), rng.uniform(-1.0, 1.0));
    std::vector<BearingRange> sightings;
    for (int k = 0; k < 4; ++k) {
      const Pose2 pose{0.2 * k, -1.0 + 0.6 * k, rng.uniform(-0.5, 0.5)};
      sightings.push_back({pose, wrap_angle(bearing_to(pose, target) + rng.normal(0.02)), 0.02, {}, 0.1});
    }
    sightings[0].range_m = (target - sightings[0].map_T_camera.translation()).norm() + rng.normal(0.1);
    const auto p = estimate_position(sightings, deg_to_rad(10.0), 8.0);
    ASSERT_TRUE(p.has_value());
    const Point2 error = p->p_map - target;
    nees += error.dot(p->covariance.inverse() * error) / kRuns;
  }
  // chi2 of 1000 degrees of freedom, 99.9 %: 0.86 to 1.15 of the mean.
  EXPECT_GT(nees, 2.0 * 0.86);
  EXPECT_LT(nees, 2.0 * 1.15);
}

TEST(DetectionTracker, RangeByTheFloorStandsInForALidarThatSeesAnotherThing) {
  DetectionParams params;
  params.size_range_factor = 0.3;
  vision::Sighting sighting = sighting_at(0.2);
  sighting.floor_range_m = sighting.range_m = 1.2;
  for (const double laser_m : {1.1, 3.0}) {
    DetectionTracker tracker({{"thing", 0.2, 0.2, 0.2}}, params);
    const LaserScan laser = scan_with(0.2, laser_m, 7.0);
    Look look;
    look.sightings = {sighting};
    look.laser = &laser;
    (void)tracker.add(look);
    const Detection seen = tracker.detections().at(0);
    ASSERT_TRUE(seen.position_map);
    EXPECT_EQ(seen.range_source, laser_m < 2.0 ? RangeSource::kLidar : RangeSource::kFloor);
    EXPECT_NEAR(seen.position_map->norm(), 1.2, 0.02) << "to its middle";
    const double along =
        Point2(std::cos(0.2), std::sin(0.2)).dot(seen.position_covariance * Point2(std::cos(0.2), std::sin(0.2)));
    EXPECT_NEAR(std::sqrt(along),
                laser_m < 2.0 ? std::hypot(params.lidar_sigma_m, params.depth_sigma_m) : params.floor_sigma_m, 0.01);
  }
}

// A drifted pose, common to all sightings of one target, three looks with a lidar: NEES of the fused position.
TEST(DetectionTracker, PositionErrorIsWhatItsCovarianceSays) {
  Rng rng(82);
  constexpr int kRuns = 400;
  DetectionParams params;
  double nees = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const Point2 target(rng.uniform(2.0, 3.0), rng.uniform(-0.5, 0.5));
    const Pose2 drift{rng.normal(0.05), rng.normal(0.05), rng.normal(0.02)};
    DetectionTracker tracker({{"thing"}}, params);
    for (int k = 0; k < 3; ++k) {
      const Pose2 truth{0.4 * k, 0.3 * k, 0.1 * k};
      const double bearing = wrap_angle(bearing_to(truth, target) + rng.normal(params.bearing_sigma_rad));
      const double sigma = std::hypot(params.lidar_sigma_m, params.depth_sigma_m);
      const LaserScan laser =
          scan_with(bearing, distance_m(truth, {target.x(), target.y(), 0}) + rng.normal(sigma), 7.0);
      Look look;
      // The map that the robot believes in is turned and shifted about the robot.
      look.map_T_base = {truth.x_m + drift.x_m, truth.y_m + drift.y_m, truth.theta_rad + drift.theta_rad};
      look.pose_covariance.diagonal() << 0.0025, 0.0025, 0.0004;
      look.sightings = {sighting_at(bearing)};
      look.laser = &laser;
      (void)tracker.add(look);
    }
    const auto detections = tracker.detections();
    ASSERT_EQ(detections.size(), 1U) << "run " << run;
    ASSERT_TRUE(detections[0].position_map.has_value());
    const Point2 error = *detections[0].position_map - target;
    nees += error.dot(detections[0].position_covariance.inverse() * error) / kRuns;
  }
  EXPECT_GT(nees, 2.0 * 0.7);
  EXPECT_LT(nees, 2.0 * 1.3);
}

TEST(DetectionTracker, AddsHalfTheDepthOfASolid) {
  DetectionTracker tracker({{"box", 0.4, 0.4, 0.3}}, {});
  const LaserScan laser = scan_with(0.0, 2.0, 7.0);
  Look look;
  look.sightings = {sighting_at(0.0)};
  look.laser = &laser;
  (void)tracker.add(look);
  EXPECT_THAT(*tracker.detections()[0].position_map, Point2Near(Point2(2.15, 0.0), 1e-6));
}

TEST(DetectionTracker, ConfirmsFromTwoPlacesOnly) {
  DetectionTracker tracker({{"thing"}}, {});
  const LaserScan near = scan_with(0.0, 2.0, 7.0);
  Look look;
  look.sightings = {sighting_at(0.0)};
  look.laser = &near;
  (void)tracker.add(look);
  (void)tracker.add(look);
  EXPECT_FALSE(tracker.detections()[0].confirmed);
  const LaserScan nearer = scan_with(0.0, 1.5, 7.0);
  look.map_T_base.x_m = 0.5;
  look.laser = &nearer;
  (void)tracker.add(look);
  ASSERT_EQ(tracker.detections().size(), 1U);
  EXPECT_TRUE(tracker.detections()[0].confirmed);
  EXPECT_EQ(tracker.detections()[0].sightings, 3);
}

TEST(DetectionTracker, TheSameDirectionAgainConfirmsNothingUntilItHasAPosition) {
  DetectionTracker tracker({{"thing"}}, {});
  DetectionParams printed;
  printed.confirm_position = false;
  DetectionTracker as_printed({{"thing"}}, printed);
  Look look;
  look.sightings = {sighting_at(0.0)};
  for (const double x_m : {0.0, 0.5, 1.0}) {
    look.map_T_base.x_m = x_m;
    (void)tracker.add(look);
    (void)as_printed.add(look);
  }
  ASSERT_EQ(tracker.detections().size(), 1U);
  EXPECT_FALSE(tracker.detections()[0].confirmed) << "it may be anything that the robot drives towards";
  EXPECT_TRUE(as_printed.detections()[0].confirmed);
  look.map_T_base.y_m = 0.7;
  look.sightings = {sighting_at(std::atan2(-0.7, 3.0))};  // of something at (4, 0)
  (void)tracker.add(look);
  ASSERT_EQ(tracker.detections().size(), 1U);
  EXPECT_TRUE(tracker.detections()[0].confirmed);
}

TEST(DetectionTracker, KeepsDistantThingsApart) {
  DetectionTracker tracker({{"thing"}, {"other"}}, {});
  const LaserScan laser = scan_with(0.0, 2.0, 2.0);
  Look look;
  look.laser = &laser;
  look.sightings = {sighting_at(0.0), sighting_at(1.0), sighting_at(0.0)};
  look.sightings[2].target = 1;
  EXPECT_EQ(tracker.add(look), (std::vector<std::uint64_t>{1, 2, 3}));
  EXPECT_EQ(tracker.add(look), (std::vector<std::uint64_t>{1, 2, 3}));
}

TEST(DetectionTracker, LooksInVainRefute) {
  DetectionParams params;
  DetectionTracker tracker({{"thing"}}, params);
  const LaserScan laser = scan_with(0.0, 2.0, 7.0);
  Look look;
  look.sightings = {sighting_at(0.0)};
  look.laser = &laser;
  (void)tracker.add(look);
  const auto sure = [](const Point2&, int) { return 0.9; };
  const auto blind = [](const Point2&, int) { return 0.1; };
  for (int k = 0; k < 20; ++k) {
    EXPECT_TRUE(tracker.note_misses({}, blind).empty());
  }
  for (int k = 0; k < params.max_misses; ++k) {
    EXPECT_TRUE(tracker.note_misses({}, sure).empty());
  }
  EXPECT_EQ(tracker.note_misses({}, sure), std::vector<std::uint64_t>{1});
  EXPECT_TRUE(tracker.detections().empty());
}

TEST(DetectionTracker, OfADoubtfulSightingTheNextPictureDecides) {
  const auto sure = [](const Point2& p, int) { return (p - Point2(2.0, 0.0)).norm() < 0.1 ? 0.9 : 0.0; };
  Look look;
  look.sightings = {sighting_at(0.0, 0.7)};
  look.sightings[0].range_m = 2.0;
  DetectionTracker doubtful({{"thing"}}, {});
  ASSERT_EQ(doubtful.add(look), std::vector<std::uint64_t>{1});
  EXPECT_FALSE(doubtful.find(1)->position_map);
  EXPECT_THAT(*doubtful.presumed_place(1), Point2Near(Point2(2.0, 0.0), 1e-9));
  doubtful.transform(MapMove{Pose2{0.0, 1.0, 0.0}});
  EXPECT_THAT(*doubtful.presumed_place(1), Point2Near(Point2(2.0, 1.0), 1e-9));
  doubtful.transform(MapMove{Pose2{0.0, -1.0, 0.0}});
  EXPECT_EQ(doubtful.note_misses({}, sure), std::vector<std::uint64_t>{1});

  look.sightings[0].score = 0.85;
  DetectionTracker clear({{"thing"}}, {});
  ASSERT_EQ(clear.add(look), std::vector<std::uint64_t>{1});
  for (int k = 0; k < 5; ++k) {
    EXPECT_TRUE(clear.note_misses({}, sure).empty()) << "without a position there is no place where it is missed";
  }
}

TEST(DetectionTracker, IgnoresWhatMakesNoSense) {
  DetectionTracker tracker({{"thing"}}, {});
  Look look;
  look.sightings = {sighting_at(std::nan("")), sighting_at(0.0), sighting_at(0.0)};
  look.sightings[1].target = 7;
  look.sightings[2].target = -1;
  EXPECT_TRUE(tracker.add(look).empty());
}

}  // namespace
}  // namespace seeker::search
