#include "server/slam/odometry_scale.hpp"

#include <gtest/gtest.h>

#include "common/core/rng.hpp"

namespace seeker::slam {
namespace {

const Matrix3 kStated = Eigen::Vector3d(1e-4, 1e-4, 4e-4).asDiagonal();

/// Many motions whose true deviations are `displacement` and `rotation` times the stated ones.
OdometryScale after_motions(double displacement, double rotation) {
  Rng rng(5);
  OdometryScale scale;
  for (int k = 0; k < 500; ++k) {
    const Eigen::Vector3d off(rng.normal(displacement * 0.01), rng.normal(displacement * 0.01),
                              rng.normal(rotation * 0.02));
    scale.learn(off, scale.applied_to(kStated));
  }
  return scale;
}

TEST(OdometryScale, LeavesOdometryThatIsAsGoodAsItSays) {
  const OdometryScale scale = after_motions(1.0, 1.0);
  // It follows large errors fast and small ones slowly: on the careful side, by this much at most.
  EXPECT_LT(scale.displacement(), 4.0);
  EXPECT_LT(scale.rotation(), 6.0);
  EXPECT_GE(scale.displacement(), 1.0);
  EXPECT_GE(scale.rotation(), 1.0);
}

TEST(OdometryScale, DistinguishesBadRotationsFromBadDisplacements) {
  const OdometryScale rotations = after_motions(1.0, 6.0);
  EXPECT_GT(rotations.rotation(), 36.0);
  EXPECT_LT(rotations.displacement(), 4.0);
  const OdometryScale displacements = after_motions(6.0, 1.0);
  EXPECT_GT(displacements.displacement(), 36.0);
  EXPECT_LT(displacements.rotation(), 6.0);
}

TEST(OdometryScale, WidensDisplacementAndRotationByTheirOwnFactors) {
  OdometryScale scale;
  scale.learn({0.0, 0.0, 0.2}, kStated);  // ten deviations off in the rotation
  const Matrix3 widened = scale.applied_to(kStated);
  EXPECT_GT(scale.rotation(), 20.0);
  EXPECT_DOUBLE_EQ(widened(0, 0), kStated(0, 0));
  EXPECT_NEAR(widened(2, 2), scale.rotation() * kStated(2, 2), 1e-12);
}

TEST(OdometryScale, ForgetsOneSlipWhileTheWheelsHoldAgain) {
  OdometryScale scale;
  scale.learn({1.0, 0.0, 0.0}, kStated);
  const double slipped = scale.displacement();
  EXPECT_GT(slipped, 20.0);
  for (int k = 0; k < 400; ++k) {
    scale.learn({0.005, 0.005, 0.01}, kStated);
  }
  EXPECT_LT(scale.displacement(), 0.1 * slipped);
}

}  // namespace
}  // namespace seeker::slam
