#include "server/fleet/pair_fusion.hpp"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "common/core/rng.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::fleet {
namespace {

using testing::Pose2Near;

const Pose2 kTruth{3.0, -2.0, 0.7};

Matrix3 sigmas(double x_m, double y_m, double theta_rad) {
  return Eigen::Vector3d(x_m, y_m, theta_rad).cwiseAbs2().asDiagonal();
}

/// A pair at a local map of b that is off by so much in the frame of map a.
PairPlace pair_at(const Pose2& map_b_T_node, const Matrix3& covariance, const Pose2& off = {}) {
  const Pose2 true_pose = kTruth * map_b_T_node;
  return {{{true_pose.x_m + off.x_m, true_pose.y_m + off.y_m, true_pose.theta_rad + off.theta_rad}, covariance},
          map_b_T_node};
}

TEST(PairFusion, OnePairIsTakenAtItsWord) {
  const UncertainPose whole = fuse({pair_at({4.0, 1.0, -0.3}, sigmas(0.05, 0.05, 0.01))}, {});
  EXPECT_THAT(whole.a_T_b, Pose2Near(kTruth, 1e-9, 1e-9));
}

TEST(PairFusion, APairInABareCorridorHasNoSayAlongIt) {
  // The second one slid 6 m along its corridor, and says that it may have.
  const std::vector<PairPlace> pairs{pair_at({0.0, 0.0, 0.0}, sigmas(0.05, 0.05, 0.01)),
                                     pair_at({8.0, 0.0, 0.0}, sigmas(10.0, 0.05, 0.01), {6.0, 0.0, 0.0})};
  EXPECT_THAT(fuse(pairs, {}).a_T_b, Pose2Near(kTruth, 0.01, 0.002));
}

TEST(PairFusion, TwoCorridorsAcrossEachOtherDetermineThePlaceTogether) {
  const std::vector<PairPlace> pairs{pair_at({0.0, 0.0, 0.0}, sigmas(10.0, 0.05, 0.01), {4.0, 0.0, 0.0}),
                                     pair_at({5.0, 5.0, 1.0}, sigmas(0.05, 10.0, 0.01), {0.0, -4.0, 0.0})};
  EXPECT_THAT(fuse(pairs, {}).a_T_b, Pose2Near(kTruth, 0.01, 0.002));
}

TEST(PairFusion, PlacesFarApartDetermineTheHeadingBetterThanTheirOwnHeadingsDo) {
  const auto heading_sigma = [](double apart_m) {
    return std::sqrt(fuse({pair_at({0.0, 0.0, 0.0}, sigmas(0.05, 0.05, 0.02)),
                           pair_at({apart_m, 0.0, 0.0}, sigmas(0.05, 0.05, 0.02))},
                          {})
                         .covariance(2, 2));
  };
  EXPECT_LT(heading_sigma(20.0), 0.3 * heading_sigma(0.5));
}

TEST(PairFusion, ItsErrorsAreOfTheSizeThatItSays) {
  constexpr int kRuns = 2000;
  Rng rng(5);
  DistortionParams none;
  none.sigma_m = none.sigma_rad = 1e-6;
  double nees = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<PairPlace> pairs;
    for (int k = 0; k < 4; ++k) {
      const double x_m = rng.uniform(0.02, 0.2);
      const double y_m = rng.uniform(0.02, 0.2);
      const Pose2 node{rng.uniform(-10.0, 10.0), rng.uniform(-10.0, 10.0), rng.uniform(-3.0, 3.0)};
      pairs.push_back(pair_at(node, sigmas(x_m, y_m, 0.01), {rng.normal(x_m), rng.normal(y_m), rng.normal(0.01)}));
    }
    const UncertainPose whole = fuse(pairs, none);
    const Eigen::Vector3d error = offset_of(whole.a_T_b, kTruth);
    nees += error.dot(whole.covariance.ldlt().solve(error)) / kRuns;
  }
  EXPECT_NEAR(nees, 3.0, 0.25);  // 3 degrees of freedom; 4.5 sigma of the mean of so many
}

TEST(PairFusion, ALocalMapIsCarriedByTheNearestPairWhereThatKnowsBetter) {
  // The map of b is distorted: its far end lies 0.3 m off.
  const Pose2 distortion{0.0, 0.3, 0.0};
  const std::vector<PairPlace> sure{pair_at({0.0, 0.0, 0.0}, sigmas(0.03, 0.03, 0.01)),
                                    pair_at({20.0, 0.0, 0.0}, sigmas(0.03, 0.03, 0.01), distortion)};
  const Pose2 far = pair_at({20.0, 0.0, 0.0}, Matrix3::Zero(), distortion).map_a_T_node.a_T_b;
  EXPECT_THAT(carried(sure, kTruth, {20.0, 0.0, 0.0}, {}), Pose2Near(far, 0.02, 0.01));
  EXPECT_THAT(carried(sure, kTruth, {0.0, 0.0, 0.0}, {}), Pose2Near(kTruth, 0.01, 0.01));
  // The same from a bare corridor moves nothing.
  const std::vector<PairPlace> unsure{pair_at({20.0, 0.0, 0.0}, sigmas(0.03, 10.0, 0.01), {0.0, 5.0, 0.0})};
  EXPECT_THAT(carried(unsure, kTruth, {20.0, 0.0, 0.0}, {}), Pose2Near(kTruth * Pose2{20.0, 0.0, 0.0}, 0.03, 0.01));
}

}  // namespace
}  // namespace seeker::fleet
