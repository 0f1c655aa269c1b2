/// Life of the map: segments come, grow, get ends, become one, go; poses are measured; the robot is moved.
#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "sp_world.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::slam {
namespace {

using lines::SegmentObservation;
using test::SensorNoise;
using test::TrueWall;
using testing::Pose2Near;

constexpr SensorNoise kNoise{0.01, 0.005, 0.02};
const Matrix3 kStart = 1e-4 * Matrix3::Identity();

const TrueWall kWall = test::wall_between({-3.0, 2.0}, {3.0, 2.0});

SegmentObservation part(double from_m, double to_m, const std::array<bool, 2>& real = {false, false},
                        const TrueWall& wall = kWall, const Pose2& truth = {}) {
  return see(truth, wall, from_m, to_m, real, kNoise, Vector4::Zero());
}

SpUpdateReport feed(SpMap& map, const std::vector<SegmentObservation>& seen) {
  return map.update(seen, map.associate(seen));
}

TEST(SpMap, PredictsAsEquation11) {
  SpMap map({1.0, 2.0, kPi / 2.0}, kStart);
  map.predict({2.0, 0.0, 0.0}, Eigen::Vector3d(0.01, 0.0, 0.0).asDiagonal().toDenseMatrix());
  EXPECT_THAT(map.robot(), Pose2Near(Pose2{1.0, 4.0, kPi / 2.0}, 1e-12, 1e-12));
  // Sideways the heading error of 0.01 rad acts over 2 m; along, in the map's y, the increment's own 0.1 m.
  EXPECT_NEAR(map.robot_covariance()(0, 0), 1e-4 + 0.01, 1e-9);
  EXPECT_NEAR(map.robot_covariance()(1, 1), 1e-4 + 4e-4, 1e-9);
  EXPECT_NEAR(map.robot_covariance_map()(1, 1), 1e-4 + 0.01, 1e-9);
}

TEST(SpMap, BelievesManyPointsAtOnceAndFewTheSecondTime) {
  SpMap map({}, kStart);
  SegmentObservation thin = part(-1.0, 1.0);
  thin.points = 8;
  EXPECT_EQ(feed(map, {thin}).created.size(), 0U);
  EXPECT_EQ(feed(map, {}).created.size(), 0U);
  EXPECT_EQ(feed(map, {thin}).created.size(), 0U) << "not consecutive";
  EXPECT_EQ(feed(map, {thin}).created.size(), 1U);
  const SegmentObservation thick = part(-1.0, 1.0, {false, false}, test::wall_between({3.0, 1.0}, {3.0, -1.0}));
  EXPECT_EQ(feed(map, {thick}).created.size(), 1U);
  ASSERT_EQ(map.segments().size(), 2U);
  EXPECT_EQ(map.segments()[0].hits, 1);
  EXPECT_EQ(map.segments()[1].created, 5U);
}

TEST(SpMap, LetsVirtualEndsGrowAndNeverShrink) {
  SpMap map({}, kStart);
  feed(map, {part(-1.0, 1.0)});
  feed(map, {part(-0.5, 2.5)});
  feed(map, {part(-0.2, 0.2)});
  ASSERT_EQ(map.segments().size(), 1U);
  const SpSegment& segment = map.segments()[0];
  EXPECT_NEAR(segment.length_m, 3.5, 1e-3);
  EXPECT_THAT(segment.map_T_segment, Pose2Near(Pose2{0.75, 2.0, 0.0}, 1e-3, 1e-3));
  EXPECT_EQ(segment.hits, 3);
  EXPECT_EQ(segment.last_seen, 3U);
}

TEST(SpMap, MakesAnEndRealWhenItWasSeenTwice) {
  SpMap map({}, kStart);
  feed(map, {part(-1.0, 1.0, {false, true})});
  EXPECT_FALSE(map.segments()[0].real[lines::kRight]);
  feed(map, {part(-1.0, 1.0, {false, true})});
  const SpSegment& segment = map.segments()[0];
  EXPECT_TRUE(segment.real[lines::kRight]);
  EXPECT_FALSE(segment.real[lines::kLeft]);
  const SegmentCovariance covariance = map.segment_covariance(segment.id);
  ASSERT_EQ(covariance.rows(), 3);
  // Sensor (0.02 m) and robot: the start's 0.01 m, and its heading over the wall's distance of 2 m.
  EXPECT_NEAR(std::sqrt(covariance(2, 2)), std::sqrt(4e-4 + 1e-4 + 4e-4), 2e-3);
  const double before = covariance(2, 2);
  EXPECT_EQ(feed(map, {part(-1.0, 1.0, {false, true})}).ends, 1);
  EXPECT_LT(map.segment_covariance(segment.id)(2, 2), before);
}

TEST(SpMap, UsesAnEndAgainWhenOtherBeamsSeeIt) {
  SpMap map({}, kStart);
  // The end is at 63 degrees; from 0.1 m farther on it is 2.2 degrees farther round.
  const auto seen_from = [](const Pose2& truth) {
    SegmentObservation seen = part(-1.0, 1.0, {false, true}, kWall, truth);
    seen.beam_step_rad = deg_to_rad(1.0);
    return seen;
  };
  feed(map, {seen_from({})});
  feed(map, {seen_from({})});
  ASSERT_TRUE(map.segments()[0].real[lines::kRight]);
  for (int scan = 0; scan < 5; ++scan) {
    EXPECT_EQ(feed(map, {seen_from({})}).ends, 0) << "the same two beams see where it is";
  }
  const Pose2 step{0.1, 0.0, 0.0};
  map.predict(step, 1e-6 * Matrix3::Identity());
  EXPECT_EQ(feed(map, {seen_from(step)}).ends, 1);
  EXPECT_EQ(feed(map, {seen_from(step)}).ends, 0);
}

TEST(SpMap, TakesBackAnEndThatIsOverrunAgainAndAgain) {
  SpMap map({}, kStart);
  for (int k = 0; k < 3; ++k) {
    feed(map, {part(-1.0, 1.0, {true, true})});
  }
  ASSERT_TRUE(map.segments()[0].real[lines::kRight]);
  feed(map, {part(-1.0, 2.0)});
  feed(map, {part(-1.0, 2.0)});
  EXPECT_TRUE(map.segments()[0].real[lines::kRight]);
  feed(map, {part(-1.0, 2.0)});
  EXPECT_FALSE(map.segments()[0].real[lines::kRight]);
  EXPECT_TRUE(map.segments()[0].real[lines::kLeft]);
  EXPECT_NEAR(map.segments()[0].length_m, 3.0, 1e-3);
  EXPECT_EQ(map.covariance().rows(), 3 + 3);
}

TEST(SpMap, MergesThePiecesOfAWallButNotOverADoorway) {
  SpMap map({}, kStart);
  EXPECT_EQ(feed(map, {part(-2.0, -0.5), part(0.5, 2.0)}).merged.size(), 0U);
  const SpUpdateReport report = feed(map, {part(-2.0, -0.1, {true, false}), part(0.1, 2.0, {false, true})});
  ASSERT_EQ(report.merged.size(), 1U);
  EXPECT_EQ(report.merged[0].kept, 1U);
  EXPECT_EQ(report.merged[0].gone, 2U);
  ASSERT_EQ(map.segments().size(), 1U);
  EXPECT_NEAR(map.segments()[0].length_m, 4.0, 1e-3);
  EXPECT_THAT(map.segments()[0].map_T_segment, Pose2Near(Pose2{0.0, 2.0, 0.0}, 1e-3, 1e-3));
  EXPECT_EQ(map.find(2), nullptr);

  SpMapParams params;
  params.features.real_scans = 1;
  SpMap doorway({}, kStart, params);
  feed(doorway, {part(-2.0, -0.1, {false, true}), part(0.1, 2.0, {true, false})});
  EXPECT_EQ(doorway.segments().size(), 2U);
}

TEST(SpMap, MergesOnlyPiecesWhoseOffsetIsKnownWell) {
  const auto merged = [](double merge_sigma_m) {
    SpMapParams params;
    params.features.merge_sigma_m = merge_sigma_m;
    SpMap map({}, kStart, params);
    feed(map, {part(-2.0, -0.5), part(0.5, 2.0)});
    return feed(map, {part(-2.0, -0.1, {true, false}), part(0.1, 2.0, {false, true})}).merged.size();
  };
  EXPECT_EQ(merged(0.0), 1U);
  EXPECT_EQ(merged(0.1), 1U);
  EXPECT_EQ(merged(1e-4), 0U);
}

TEST(SpMap, TakesTheRealEndOfThePieceThatGoes) {
  SpMapParams params;
  params.features.real_scans = 1;
  SpMap map({}, kStart, params);
  feed(map, {part(-2.0, -0.6), part(0.5, 2.0, {false, true})});
  feed(map, {part(-2.0, 0.4)});
  ASSERT_EQ(map.segments().size(), 1U);
  EXPECT_TRUE(map.segments()[0].real[lines::kRight]);
  EXPECT_EQ(map.segment_covariance(1).rows(), 3);
  EXPECT_NEAR(std::sqrt(map.segment_covariance(1)(2, 2)), std::hypot(0.02, 0.02), 0.01);
}

TEST(SpMap, NeverUsesAnIdTwice) {
  SpMap map({}, kStart);
  feed(map, {part(-1.0, 1.0)});
  EXPECT_TRUE(map.forget(1));
  EXPECT_FALSE(map.forget(1));
  EXPECT_TRUE(map.segments().empty());
  EXPECT_EQ(map.covariance().rows(), 3);
  feed(map, {part(-1.0, 1.0)});
  EXPECT_EQ(map.segments()[0].id, 2U);
}

TEST(SpMap, AssociationOfAForgottenSegmentIsNoPair) {
  SpMap map({}, kStart);
  const std::vector<SegmentObservation> seen{part(-1.0, 1.0)};
  feed(map, seen);
  const Association association = map.associate(seen);
  map.forget(1);
  EXPECT_EQ(map.update(seen, association).paired, 0);
}

/// A sweep of 180 beams that returns `range_m` everywhere.
LaserScan sweep(double range_m) {
  LaserScan scan;
  scan.angle_min_rad = 0.0;
  scan.angle_step_rad = deg_to_rad(1.0);
  scan.range_max_m = 10.0;
  scan.ranges_m.assign(181, static_cast<float>(range_m));
  return scan;
}

TEST(SpMap, ForgetsASegmentThatIsLookedThrough) {
  SpMapParams params;
  for (const double step_deg : {1.0, -1.0}) {  // scanners rotate in either direction
    SpMap map({}, kStart, params);
    for (int k = 0; k < 10; ++k) {
      feed(map, {part(-1.0, 1.0)});
    }
    LaserScan through = sweep(6.0);
    through.angle_step_rad = deg_to_rad(step_deg);
    through.angle_min_rad = step_deg > 0.0 ? 0.0 : kPi;
    LaserScan hidden = through;
    hidden.ranges_m.assign(181, 1.0F);
    LaserScan silent = through;
    silent.ranges_m.assign(181, kNoReturn);
    for (int k = 0; k < 20; ++k) {
      EXPECT_TRUE(map.observe_free_space(hidden).empty()) << "an obstacle stands before it";
      EXPECT_TRUE(map.observe_free_space(silent).empty()) << "no return is no evidence";
    }
    for (int k = 1; k < params.existence.misses; ++k) {
      EXPECT_TRUE(map.observe_free_space(through).empty()) << k;
    }
    EXPECT_EQ(map.observe_free_space(through), std::vector<SegmentId>{1}) << "step " << step_deg;
    EXPECT_TRUE(map.segments().empty());
  }
}

TEST(SpMap, ForgetsAYoungSegmentSoonAndOneSeenAgainNever) {
  SpMap map({}, kStart);
  feed(map, {part(-1.0, 1.0)});
  EXPECT_TRUE(map.observe_free_space(sweep(6.0)).empty());
  LaserScan on = sweep(2.0);
  for (std::size_t k = 0; k < on.ranges_m.size(); ++k) {
    on.ranges_m[k] = static_cast<float>(2.0 / std::max(0.1, std::sin(on.angle_rad(k))));
  }
  EXPECT_TRUE(map.observe_free_space(on).empty());
  EXPECT_EQ(map.segments()[0].misses, 0);
  EXPECT_TRUE(map.observe_free_space(sweep(6.0)).empty());
  EXPECT_EQ(map.observe_free_space(sweep(6.0)).size(), 1U);
}

TEST(SpMap, TakesAPoseMeasurementAsAKalmanFilterDoes) {
  SpMap map({1.0, 1.0, kPi / 2.0}, Eigen::Vector3d(0.04, 0.01, 0.01).asDiagonal().toDenseMatrix());
  // In the frame `map` the robot's own x is y: variance 0.04 there, 0.01 in x.
  const Matrix3 measured = 0.01 * Matrix3::Identity();
  const double d2 = map.observe_pose({1.1, 1.5, kPi / 2.0}, measured);
  EXPECT_NEAR(map.robot().y_m, 1.0 + 0.5 * 0.04 / 0.05, 1e-6);
  EXPECT_NEAR(map.robot().x_m, 1.0 + 0.1 * 0.5, 1e-6);
  EXPECT_NEAR(d2, 0.25 / 0.05 + 0.01 / 0.02, 1e-6);
  EXPECT_NEAR(map.robot_covariance_map()(1, 1), 0.04 * 0.01 / 0.05, 1e-6);
}

TEST(SpMap, TakesNothingAlongADegenerateDirection) {
  SpMap map({0.0, 0.0, 0.3}, 0.04 * Matrix3::Identity());
  const Point2 along = Point2(1.0, 1.0).normalized();
  const Pose2 measured{1.0, 0.0, 0.3};
  const double d2 = map.pose_d2(measured, 1e-6 * Matrix3::Identity(), along);
  EXPECT_EQ(map.observe_pose(measured, 1e-6 * Matrix3::Identity(), along), d2);
  // Only the part across is taken: (0.5, -0.5) of (1, 0).
  EXPECT_THAT(map.robot(), Pose2Near(Pose2{0.5, -0.5, 0.3}, 1e-3, 1e-3));
  const Matrix2 covariance = map.robot_covariance_map().topLeftCorner<2, 2>();
  EXPECT_NEAR(along.dot(covariance * along), 0.04, 1e-6);
}

TEST(SpMap, MovesTheRobotWithoutTheMap) {
  SpMap map({}, kStart);
  feed(map, {part(-1.0, 1.0)});
  EXPECT_GT(map.segment_robot_covariance(1).norm(), 1e-5);
  const SegmentCovariance before = map.segment_covariance(1);
  map.set_robot({5.0, 5.0, 1.0}, 0.25 * Matrix3::Identity());
  EXPECT_EQ(map.segment_robot_covariance(1).norm(), 0.0);
  EXPECT_EQ(map.segment_covariance(1), before);
  EXPECT_EQ(map.robot(), (Pose2{5.0, 5.0, 1.0}));
  EXPECT_NEAR(map.robot_covariance()(0, 0), 0.25, 1e-9);
}

TEST(SpMap, SaysThatACorridorHoldsOneDirectionOnly) {
  const TrueWall left = test::wall_between({-4.0, 1.0}, {4.0, 1.0});
  const TrueWall right = test::wall_between({4.0, -1.0}, {-4.0, -1.0});
  const Pose2 truth{0.0, 0.0, 0.4};
  SpMap map(truth, kStart);
  const std::vector<SegmentObservation> walls{part(-3.0, 3.0, {false, false}, left, truth),
                                              part(-3.0, 3.0, {false, false}, right, truth)};
  feed(map, walls);
  EXPECT_TRUE(map.observability().degenerate_direction.has_value()) << "nothing was paired yet";
  feed(map, walls);
  ASSERT_TRUE(map.observability().degenerate_direction.has_value());
  EXPECT_NEAR(std::abs(map.observability().weak_direction.x()), 1.0, 1e-3);
  EXPECT_GT(map.observability().weak_sigma_m, 1e3);
  std::vector<SegmentObservation> closed = walls;
  closed.push_back(part(-1.0, 1.0, {false, false}, test::wall_between({4.0, 1.0}, {4.0, -1.0}), truth));
  feed(map, closed);
  feed(map, closed);
  EXPECT_FALSE(map.observability().degenerate_direction.has_value());
  EXPECT_NEAR(map.observability().weak_sigma_m, kNoise.y_m, 0.005);
}

TEST(SpMap, LinearisesOnceMoreAfterALargeCorrection) {
  const std::vector<TrueWall> walls = test::room();
  const auto seen_from = [&](const Pose2& truth) {
    std::vector<SegmentObservation> seen;
    for (const TrueWall& wall : walls) {
      seen.push_back(part(-2.5, 2.5, {false, false}, wall, truth));
    }
    return seen;
  };
  SpMap map({}, 1e-10 * Matrix3::Identity());
  for (int k = 0; k < 50; ++k) {
    feed(map, seen_from({}));
  }
  SpMap once = map;
  const Pose2 truth{0.4, -0.5, 0.35};
  map.predict({}, 0.1 * Matrix3::Identity());
  EXPECT_EQ(feed(map, seen_from(truth)).iterations, 2);
  SpMapParams params;
  params.relinearise_m = 1e9;
  params.relinearise_rad = 1e9;
  SpMap coarse({}, 1e-10 * Matrix3::Identity(), params);
  for (int k = 0; k < 50; ++k) {
    feed(coarse, seen_from({}));
  }
  coarse.predict({}, 0.1 * Matrix3::Identity());
  EXPECT_EQ(feed(coarse, seen_from(truth)).iterations, 1);
  EXPECT_LT(distance_m(map.robot(), truth), 0.2 * distance_m(coarse.robot(), truth));
  EXPECT_THAT(once.robot(), Pose2Near(Pose2{}, 1e-6, 1e-6)) << "a copy is a map of its own";
}

}  // namespace
}  // namespace seeker::slam
