#include "server/slam/scan_matcher.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <iostream>

#include <Eigen/LU>

#include "rooms.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::slam {
namespace {

using testing::Pose2Near;

ReferenceCloud cloud_from(const std::vector<Wall>& walls, const Pose2& pose, Rng& rng) {
  std::vector<OrientedPoint> points = oriented_points(scan_at(walls, pose, 0.0, rng, kTwoPi));
  for (OrientedPoint& point : points) {
    point = transform(pose, point);
  }
  return ReferenceCloud(std::move(points));
}

/// As one who expects the robot at the guess, to half a metre and 0.25 rad.
MatchResult match_widely(const ReferenceCloud& reference, const std::vector<OrientedPoint>& points,
                         const Pose2& guess) {
  const Matrix3 unsure = Eigen::Vector3d(0.25, 0.25, 0.0625).asDiagonal();
  const ScanMatcher matcher;
  return matcher.match_widely(reference, points, guess, unsure, matcher.match(reference, points, guess));
}

const Pose2 kPose{2.5, 3.0, 0.3};

TEST(OrientedPoints, NormalsFaceTheSensorAndStandOnTheWall) {
  Rng rng(1);
  const auto points = oriented_points(scan_at(box(0.0, 0.0, 10.0, 6.0), kPose, 0.0, rng));
  EXPECT_GT(points.size(), 300U);
  for (const OrientedPoint& point : points) {
    EXPECT_LT(point.normal.dot(point.p - Point2(0.15, 0.0)), 0.0);
    EXPECT_NEAR(point.normal.norm(), 1.0, 1e-9);
  }
}

/// Share of the beams that are kept with a normal within 15 degrees of one of the walls', which stand square.
double share_of_right_normals(const LaserScan& scan, const Pose2& pose) {
  const auto points = oriented_points(scan);
  const auto right = std::count_if(points.begin(), points.end(), [&](const OrientedPoint& point) {
    const OrientedPoint p_map = transform(pose, point);
    return p_map.normal.cwiseAbs().maxCoeff() > std::cos(deg_to_rad(15.0));
  });
  return static_cast<double>(right) / static_cast<double>(scan.ranges_m.size());
}

TEST(OrientedPoints, ANoisyWallHasItsDirectionToo) {
  Rng rng(7);
  for (const double sigma_m : {0.005, 0.01, 0.03}) {
    const LaserScan scan = scan_at(box(0.0, 0.0, 10.0, 6.0), kPose, 0.0, rng, kPi, 12.0, sigma_m);
    EXPECT_GT(share_of_right_normals(scan, kPose), 0.9) << sigma_m;
  }
}

TEST(OrientedPoints, AnEmptyScanHasNone) {
  Rng rng(8);
  EXPECT_TRUE(oriented_points(scan_at({}, kPose, 0.0, rng)).empty());
}

TEST(ScanMatcher, FindsTheTruePoseFromANearbyGuess) {
  Rng rng(2);
  const auto reference = cloud_from(furnished_room(), {3.0, 3.0, 0.0}, rng);
  const auto points = oriented_points(scan_at(furnished_room(), kPose, 1.0, rng));
  const MatchResult match = ScanMatcher().match(reference, points, kPose * Pose2{0.15, -0.1, 0.1});
  EXPECT_THAT(match.map_T_base, Pose2Near(kPose, 0.02, 0.006));
  EXPECT_TRUE(match.converged);
  EXPECT_GT(match.inlier_ratio, 0.8);
  EXPECT_LT(match.rms_m, 0.03);
  EXPECT_FALSE(match.degenerate_direction);
}

TEST(ScanMatcher, ItsErrorIsWithinItsCovariance) {
  Rng rng(3);
  const auto reference = cloud_from(furnished_room(), {3.0, 3.0, 0.0}, rng);
  double sum = 0.0;
  constexpr int kRuns = 100;
  for (int k = 0; k < kRuns; ++k) {
    const Pose2 truth{rng.uniform(2.0, 3.8), rng.uniform(2.0, 4.5), rng.uniform(-1.0, 1.0)};
    const auto points = thin_out(oriented_points(scan_at(furnished_room(), truth, 1.0, rng)), 180);
    const MatchResult match =
        ScanMatcher().match(reference, points, truth * Pose2{rng.normal(0.05), rng.normal(0.05), rng.normal(0.03)});
    const Eigen::Vector3d error(match.map_T_base.x_m - truth.x_m, match.map_T_base.y_m - truth.y_m,
                                wrap_angle(match.map_T_base.theta_rad - truth.theta_rad));
    sum += error.dot(match.covariance.inverse() * error);
  }
  std::cout << "mean NEES of the match (3 = consistent, less = cautious): " << sum / kRuns << ", seed 3\n";
  EXPECT_LT(sum / kRuns, 6.0);
  EXPECT_GT(sum / kRuns, 0.05);
}

TEST(ScanMatcher, NamesTheDirectionOfACorridorAndKeepsTheGuessAlongIt) {
  Rng rng(4);
  const std::vector<Wall> corridor{{{-50.0, 0.0}, {50.0, 0.0}}, {{-50.0, 2.0}, {50.0, 2.0}}};
  const auto reference = cloud_from(corridor, {0.0, 1.0, 0.0}, rng);
  const auto points = oriented_points(scan_at(corridor, {0.5, 1.0, 0.05}, 1.0, rng));
  const MatchResult match = ScanMatcher().match(reference, points, {0.3, 1.1, 0.0});
  ASSERT_TRUE(match.degenerate_direction);
  EXPECT_GT(std::abs(match.degenerate_direction->x()), 0.99);
  EXPECT_NEAR(match.map_T_base.x_m, 0.3, 0.02);
  EXPECT_NEAR(match.map_T_base.y_m, 1.0, 0.02);
  EXPECT_NEAR(match.map_T_base.theta_rad, 0.05, 0.01);
  EXPECT_GT(match.covariance(0, 0), 50.0);
  EXPECT_LT(match.covariance(1, 1), 0.01);
}

TEST(ScanMatcher, CorrelativeSearchBridgesAGapOfAMetre) {
  Rng rng(5);
  const auto reference = cloud_from(furnished_room(), {3.0, 3.0, 0.0}, rng);
  const auto points = oriented_points(scan_at(furnished_room(), kPose, 1.0, rng));
  const Pose2 guess = kPose * Pose2{0.7, -0.6, 0.45};
  EXPECT_THAT(match_widely(reference, points, guess).map_T_base, Pose2Near(kPose, 0.03, 0.01));
}

TEST(ScanMatcher, ASearchDoesNotPullTheRobotBackAlongACorridorToWhereMoreOfItIsKnown) {
  Rng rng(6);
  const std::vector<Wall> corridor{{{-50.0, 0.0}, {50.0, 0.0}}, {{-50.0, 2.0}, {50.0, 2.0}}};
  std::vector<OrientedPoint> seen;
  for (const double x_m : {-1.0, -0.7, -0.4, 0.0}) {
    const Pose2 pose{x_m, 1.0, 0.0};
    for (const OrientedPoint& point : oriented_points(scan_at(corridor, pose, 0.0, rng, kPi, 6.0))) {
      seen.push_back(transform(pose, point));
    }
  }
  const ReferenceCloud reference(std::move(seen));
  const Pose2 pose{0.8, 1.0, 0.05};  // its farthest points lie 0.8 m beyond what was seen before
  const auto points = oriented_points(scan_at(corridor, pose, 1.0, rng, kPi, 6.0));
  EXPECT_THAT(match_widely(reference, points, {0.8, 1.1, 0.0}).map_T_base, Pose2Near(pose, 0.03, 0.01));
}

TEST(ScanMatcher, OfPlacesThatLookAlikeTheExpectedOneIsTaken) {
  // Pillars every 0.7 m along a wall fit one pillar on nearly as well.
  std::vector<Wall> walls = box(0.0, 0.0, 20.0, 3.0);
  for (double x_m = 0.5; x_m < 19.0; x_m += 0.7) {
    const auto pillar = box(x_m, 0.0, x_m + 0.2, 0.2);
    walls.insert(walls.end(), pillar.begin(), pillar.end());
  }
  const Pose2 pose{10.0, 1.5, 0.0};
  Rng rng(9);
  const auto reference = cloud_from(walls, pose, rng);
  const auto points = oriented_points(scan_at(walls, pose, 1.0, rng, kPi, 6.0));
  for (const double along_m : {-0.2, 0.2}) {
    const MatchResult match = match_widely(reference, points, pose * Pose2{along_m, 0.0, 0.0});
    // Not a pillar on; exact it need not be, for the wall between the pillars says nothing along itself.
    EXPECT_THAT(match.map_T_base, Pose2Near(pose, 0.15, 0.01)) << along_m;
  }
}

TEST(ScanMatcher, APlaceThatFitsNoBetterThanTheExpectedOneDoesNotMoveTheRobot) {
  std::vector<Wall> walls = box(-10.0, 0.0, 30.0, 3.0);
  for (double x_m = -9.0; x_m < 29.0; x_m += 0.7) {
    const auto pillar = box(x_m, 0.0, x_m + 0.2, 0.5);
    walls.insert(walls.end(), pillar.begin(), pillar.end());
  }
  Rng rng(10);
  const Pose2 pose{10.0, 1.5, 0.0};
  const auto reference = cloud_from(walls, pose, rng);
  const auto points = oriented_points(scan_at(walls, pose, 1.0, rng, kPi, 6.0));
  const ScanMatcher matcher;
  const MatchResult beside = matcher.match(reference, points, pose * Pose2{-0.7, 0.0, 0.0});
  ASSERT_GT(distance_m(beside.map_T_base, pose), 0.5);
  ASSERT_LT(beside.covariance(0, 0), 0.1) << "it looks certain";
  const MatchResult weighed = matcher.weighed(reference, points, pose, beside);
  EXPECT_THAT(weighed.map_T_base, Pose2Near(pose, 0.05, 0.01));
  ASSERT_TRUE(weighed.degenerate_direction);
  EXPECT_GT(std::abs(weighed.degenerate_direction->x()), 0.99);
}

TEST(ScanMatcher, WheelsThatSlippedAreContradictedAsFirmlyAsTheMatchSays) {
  Rng rng(11);
  const auto reference = cloud_from(furnished_room(), {3.0, 3.0, 0.0}, rng);
  const auto points = oriented_points(scan_at(furnished_room(), kPose, 1.0, rng));
  const ScanMatcher matcher;
  for (const double slip_m : {0.005, 0.05, 0.2}) {
    const Pose2 guess = kPose * Pose2{slip_m, 0.0, 0.0};
    const MatchResult match = matcher.match(reference, points, guess);
    const MatchResult weighed = matcher.weighed(reference, points, guess, match);
    EXPECT_EQ(weighed.map_T_base, match.map_T_base) << slip_m;
    // Beyond Huber's bound points cost less than their square: a far place is contradicted a little less firmly.
    EXPECT_LT(weighed.covariance.trace(), match.covariance.trace() + 0.25 * slip_m * slip_m) << slip_m;
  }
}

TEST(ScanMatcher, WithoutPartnersThereIsNoMatch) {
  const ReferenceCloud empty({});
  Rng rng(6);
  const auto points = oriented_points(scan_at(furnished_room(), kPose, 1.0, rng));
  const MatchResult match = ScanMatcher().match(empty, points, kPose);
  EXPECT_FALSE(match.converged);
  EXPECT_EQ(match.pairs, 0);
  EXPECT_EQ(match.map_T_base, kPose);
  EXPECT_EQ(match_widely(empty, points, kPose).pairs, 0);
  EXPECT_EQ(ScanMatcher().weighed(empty, points, {}, match).pairs, 0);
  EXPECT_EQ(ScanMatcher().match(empty, {}, kPose).inlier_ratio, 0.0);
}

}  // namespace
}  // namespace seeker::slam
