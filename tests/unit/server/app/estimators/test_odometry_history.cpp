#include "server/app/estimators/odometry_history.hpp"

#include <gtest/gtest.h>

#include "tests/support/matchers.hpp"

namespace seeker::app {
namespace {

using seeker::testing::Pose2Near;

drivers::OdometrySample sample(double stamp_s, const Pose2& odom_T_base) {
  drivers::OdometrySample out;
  out.stamp = robot_time_s(stamp_s);
  out.odom_T_base = odom_T_base;
  return out;
}

TEST(OdometryHistory, KnowsNothingBeforeTheFirstSample) {
  const OdometryHistory history;
  EXPECT_FALSE(history.at(robot_time_s(1.0)));
  EXPECT_EQ(history.now_T_then(robot_time_s(1.0)), Pose2{});
}

TEST(OdometryHistory, TellsThePoseBetweenTwoSamples) {
  OdometryHistory history;
  history.add(sample(1.0, {2.0, 0.0, 0.0}));
  history.add(sample(1.1, {2.1, 0.0, 0.2}));
  const auto then = history.at(robot_time_s(1.025));
  ASSERT_TRUE(then);
  EXPECT_EQ(then->stamp, robot_time_s(1.025));
  EXPECT_THAT(then->odom_T_base, Pose2Near(Pose2{2.025, 0.0, 0.05}, 1e-9, 1e-9));
  EXPECT_THAT(history.now_T_then(robot_time_s(1.1)), Pose2Near(Pose2{}, 1e-12, 1e-12));
  EXPECT_THAT(history.now_T_then(robot_time_s(1.0)),
              Pose2Near(inverse(Pose2{2.1, 0.0, 0.2}) * Pose2{2.0, 0.0, 0.0}, 1e-9, 1e-9));
}

TEST(OdometryHistory, StampsBeyondTheSamplesGetTheNearestOfThem) {
  OdometryHistory history;
  history.add(sample(1.0, {1.0, 0.0, 0.0}));
  history.add(sample(2.0, {2.0, 0.0, 0.0}));
  history.add(sample(1.5, {9.0, 0.0, 0.0}));  // late: left out
  EXPECT_THAT(history.at(robot_time_s(0.5))->odom_T_base, Pose2Near(Pose2{1.0, 0.0, 0.0}, 1e-12, 1e-12));
  EXPECT_THAT(history.at(robot_time_s(3.0))->odom_T_base, Pose2Near(Pose2{2.0, 0.0, 0.0}, 1e-12, 1e-12));
  EXPECT_THAT(history.at(robot_time_s(1.5))->odom_T_base, Pose2Near(Pose2{1.5, 0.0, 0.0}, 1e-9, 1e-9));
}

TEST(OdometryHistory, PredictsBeyondTheNewestSampleByItsVelocityForHalfASecond) {
  OdometryHistory history;
  EXPECT_FALSE(history.predicted_at(robot_time_s(1.0)));
  history.add(sample(1.0, {2.0, 0.0, 0.0}));
  drivers::OdometrySample newest = sample(1.1, {2.1, 0.0, 0.0});
  newest.velocity = {1.0, 0.0};
  history.add(newest);
  EXPECT_THAT(*history.predicted_at(robot_time_s(1.05)), Pose2Near(Pose2{2.05, 0.0, 0.0}, 1e-9, 1e-9));
  EXPECT_THAT(*history.predicted_at(robot_time_s(1.2)), Pose2Near(Pose2{2.2, 0.0, 0.0}, 1e-9, 1e-9));
  EXPECT_THAT(*history.predicted_at(robot_time_s(9.0)), Pose2Near(Pose2{2.6, 0.0, 0.0}, 1e-9, 1e-9));
}

TEST(OdometryHistory, OdometryThatBeginsAnewForgetsWhatWasBefore) {
  OdometryHistory history;
  history.add(sample(1.0, {30.0, 4.0, 2.0}));
  history.add(sample(1.1, {}));
  EXPECT_EQ(history.now_T_then(robot_time_s(1.0)), Pose2{});
}

TEST(OdometryHistory, KeepsTheLastTwoSecondsOfTenSamplesASecond) {
  OdometryHistory history;
  for (int k = 0; k <= 100; ++k) {
    history.add(sample(0.1 * k, {0.1 * k, 0.0, 0.0}));
  }
  EXPECT_THAT(history.now_T_then(robot_time_s(9.0)), Pose2Near(Pose2{-1.0, 0.0, 0.0}, 1e-9, 1e-9));
  EXPECT_THAT(history.now_T_then(robot_time_s(0.0)), Pose2Near(Pose2{-1.9, 0.0, 0.0}, 1e-9, 1e-9));
}

}  // namespace
}  // namespace seeker::app
