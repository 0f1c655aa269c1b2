#include "server/slam/odometry_scale.hpp"

#include <gtest/gtest.h>

#include "common/core/rng.hpp"

namespace seeker::slam {
namespace {

const Matrix3 kStated = Eigen::Vector3d(1e-4, 1e-4, 4e-4).asDiagonal();

/// Many motions whose true deviations are `way` and `turn` times the stated ones.
OdometryScale after_motions(double way, double turn) {
  Rng rng(5);
  OdometryScale scale;
  for (int k = 0; k < 500; ++k) {
    const Eigen::Vector3d off(rng.normal(way * 0.01), rng.normal(way * 0.01), rng.normal(turn * 0.02));
    scale.learn(off, scale.applied_to(kStated));
  }
  return scale;
}

TEST(OdometryScale, LeavesOdometryThatIsAsGoodAsItSays) {
  const OdometryScale scale = after_motions(1.0, 1.0);
  // It follows large errors fast and small ones slowly: on the careful side, by this much at most.
  EXPECT_LT(scale.way(), 4.0);
  EXPECT_LT(scale.turn(), 6.0);
  EXPECT_GE(scale.way(), 1.0);
  EXPECT_GE(scale.turn(), 1.0);
}

TEST(OdometryScale, TellsBadTurnsFromBadWays) {
  const OdometryScale turns = after_motions(1.0, 6.0);
  EXPECT_GT(turns.turn(), 36.0);
  EXPECT_LT(turns.way(), 4.0);
  const OdometryScale ways = after_motions(6.0, 1.0);
  EXPECT_GT(ways.way(), 36.0);
  EXPECT_LT(ways.turn(), 6.0);
}

TEST(OdometryScale, WidensWayAndTurnByTheirOwnFactors) {
  OdometryScale scale;
  scale.learn({0.0, 0.0, 0.2}, kStated);  // ten deviations off in the turn
  const Matrix3 widened = scale.applied_to(kStated);
  EXPECT_GT(scale.turn(), 20.0);
  EXPECT_DOUBLE_EQ(widened(0, 0), kStated(0, 0));
  EXPECT_NEAR(widened(2, 2), scale.turn() * kStated(2, 2), 1e-12);
}

TEST(OdometryScale, ForgetsOneSlipWhileTheWheelsHoldAgain) {
  OdometryScale scale;
  scale.learn({1.0, 0.0, 0.0}, kStated);
  const double slipped = scale.way();
  EXPECT_GT(slipped, 20.0);
  for (int k = 0; k < 400; ++k) {
    scale.learn({0.005, 0.005, 0.01}, kStated);
  }
  EXPECT_LT(scale.way(), 0.1 * slipped);
}

}  // namespace
}  // namespace seeker::slam
