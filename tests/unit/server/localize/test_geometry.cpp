#include "server/localize/geometry.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"

namespace seeker::localize {
namespace {

vision::StereoFeature feature_at(double u_px, double v_px, double disparity_px) {
  vision::StereoFeature feature;
  feature.left.u_px = static_cast<float>(u_px);
  feature.left.v_px = static_cast<float>(v_px);
  feature.disparity_px = disparity_px;
  return feature;
}

TEST(Triangulation, FollowsEquationsTwoToFour) {
  const StereoGeometry geometry;
  const auto point = triangulate(geometry, feature_at(412.0, 284.0, 20.0), {});
  ASSERT_TRUE(point.has_value());
  const double ahead_m = 0.12 * 839.478943 / 20.0;  // 5.04 m, as the specification's check of constraint 2 says
  EXPECT_NEAR(point->p.x(), ahead_m, 1e-9);
  EXPECT_NEAR(point->p.y(), 100.0 * ahead_m / 839.478943, 1e-6) << "left of the middle of the picture is left";
  EXPECT_NEAR(point->p.z(), 100.0 * ahead_m / 839.478943, 1e-6) << "above the middle is up";
}

TEST(Triangulation, OfNoDisparityIsNothing) {
  EXPECT_FALSE(triangulate({}, feature_at(512, 384, 0.0), {}));
  EXPECT_FALSE(triangulate({}, feature_at(512, 384, std::nan("")), {}));
}

TEST(Triangulation, CovarianceIsThatOfNoisyPixels) {
  const StereoGeometry geometry;
  for (const bool separate_eyes : {false, true}) {
    const PixelNoise noise{0.5, 0.3, separate_eyes};
    const auto point = triangulate(geometry, feature_at(300.0, 500.0, 30.0), noise);
    Rng rng(5);
    Matrix3 sampled = Matrix3::Zero();
    constexpr int kSamples = 20000;
    for (int i = 0; i < kSamples; ++i) {
      const double left = rng.normal(noise.sigma_px);
      const double disparity = separate_eyes ? left - rng.normal(noise.sigma_px) : rng.normal(0.3);
      const auto noisy =
          triangulate(geometry, feature_at(300.0 + left, 500.0 + rng.normal(noise.sigma_px), 30.0 + disparity), noise);
      const Point3 error = noisy->p - point->p;
      sampled += error * error.transpose() / kSamples;
    }
    EXPECT_LT((sampled - point->covariance).norm(), 0.05 * point->covariance.norm()) << separate_eyes;
  }
}

RC_GTEST_PROP(EyeFrame, MapAndEyeAreInverse, ()) {
  const auto number = [](int limit) { return *rc::gen::inRange(-limit, limit) / 100.0; };
  const Pose2 pose{number(1000), number(1000), number(314)};
  const Point3 p(number(800), number(800), number(200));
  RC_ASSERT((to_eye(pose, 0.9, to_map(pose, 0.9, p)) - p).norm() < 1e-9);
}

TEST(EyeFrame, FollowsEquationsFiveToSeven) {
  const Pose2 pose{1.0, 2.0, 0.7};
  const double x_left = 0.4;
  const double y_up = 0.3;
  const double z_ahead = 2.0;
  const Point3 p = to_map(pose, 1.1, {z_ahead, x_left, y_up});
  EXPECT_NEAR(p.x(), 1.0 + z_ahead * std::cos(0.7) - x_left * std::sin(0.7), 1e-12);
  EXPECT_NEAR(p.y(), 2.0 + z_ahead * std::sin(0.7) + x_left * std::cos(0.7), 1e-12);
  EXPECT_NEAR(p.z(), 1.4, 1e-12);
}

TEST(EyeFrame, JacobianIsThatOfDifferences) {
  const Pose2 pose{1.0, 2.0, 0.7};
  const Point3 p(2.0, 0.4, 0.3);
  constexpr double kStep = 1e-6;
  const Matrix3 jacobian = to_map_jacobian(pose, p);
  const auto moved = [&](double dx, double dy, double dtheta) {
    return to_map({pose.x_m + dx, pose.y_m + dy, pose.theta_rad + dtheta}, 0.0, p);
  };
  EXPECT_LT(((moved(kStep, 0, 0) - moved(-kStep, 0, 0)) / (2 * kStep) - jacobian.col(0)).norm(), 1e-8);
  EXPECT_LT(((moved(0, kStep, 0) - moved(0, -kStep, 0)) / (2 * kStep) - jacobian.col(1)).norm(), 1e-8);
  EXPECT_LT(((moved(0, 0, kStep) - moved(0, 0, -kStep)) / (2 * kStep) - jacobian.col(2)).norm(), 1e-8);
}

TEST(Projection, IsTheInverseOfTriangulation) {
  const StereoGeometry geometry;
  const auto point = triangulate(geometry, feature_at(300.0, 500.0, 30.0), {});
  const auto pixel = project(geometry, point->p);
  ASSERT_TRUE(pixel.has_value());
  EXPECT_NEAR(pixel->u_px, 300.0, 1e-9);
  EXPECT_NEAR(pixel->v_px, 500.0, 1e-9);
  EXPECT_NEAR(pixel->disparity_px, 30.0, 1e-9);
  EXPECT_FALSE(project(geometry, {-1.0, 0.0, 0.0})) << "behind the eye";
  EXPECT_FALSE(project(geometry, {1.0, 2.0, 0.0})) << "beside the picture";
}

TEST(Seeing, LeavesOutWhatIsTooNearOrTooFar) {
  Sighting sighting;
  sighting.features = {feature_at(512, 384, 200.0), feature_at(512, 384, 40.0), feature_at(512, 384, 5.0)};
  const auto points = see({}, sighting, {}, {0.6, 8.0});
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].feature, 1U);
  EXPECT_NEAR(points[0].to_eye.x(), -1.0, 1e-9);
}

TEST(Seeing, AddsTheUncertaintyOfThePose) {
  Sighting sighting;
  sighting.features = {feature_at(512, 384, 40.0)};
  const Matrix3 sure = see({}, sighting, {}, {})[0].map.covariance;
  sighting.pose_covariance = Eigen::Vector3d(0.01, 0.04, 0.0001).asDiagonal();
  const Matrix3 unsure = see({}, sighting, {}, {})[0].map.covariance;
  const double range_m = 0.12 * 839.478943 / 40.0;
  EXPECT_NEAR((unsure - sure)(0, 0), 0.01, 1e-9);
  EXPECT_NEAR((unsure - sure)(1, 1), 0.04 + 0.0001 * range_m * range_m, 1e-9);
}

}  // namespace
}  // namespace seeker::localize
