#include "server/localize/eye_filter.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"

namespace seeker::localize {
namespace {

EyeBelief belief_at(const Pose2& pose, double sigma_m = 0.05, double sigma_rad = 0.03, double sigma_px = 0.0) {
  EyeBelief belief;
  belief.map_T_eye = pose;
  belief.covariance =
      Eigen::Vector4d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad, sigma_px * sigma_px).asDiagonal();
  return belief;
}

/// A noisy measurement of a landmark from `truth`, drawn from the noise that it states.
RangeBearing sight_of(const Point2& landmark, const Pose2& truth, Rng& rng, double range_sigma_m = 0.05) {
  RangeBearing seen;
  const Point2 offset = landmark - truth.translation();
  seen.range_m = offset.norm() + rng.normal(range_sigma_m);
  seen.beta_rad = wrap_angle(std::atan2(offset.y(), offset.x()) - truth.theta_rad + kPi / 2.0 + rng.normal(0.005));
  seen.covariance = Eigen::Vector2d(range_sigma_m * range_sigma_m, 0.005 * 0.005).asDiagonal();
  seen.range_per_disparity_m = -offset.norm() * offset.norm() / 100.7;
  seen.landmark = landmark;
  return seen;
}

TEST(Motion, FollowsEquationEleven) {
  const LeverArm arm{0.15, 0.06, 0.0};
  EyeBelief belief = belief_at({2.36, 6.79, 0.4});
  predict(belief, {0.07, 0.23}, 0.5, arm, {}, false);
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  EXPECT_NEAR(belief.map_T_eye.x_m, 2.36 + 0.5 * (0.07 * c - 0.23 * (0.15 * s + 0.06 * c)), 1e-12);
  EXPECT_NEAR(belief.map_T_eye.y_m, 6.79 + 0.5 * (0.07 * s + 0.23 * (0.15 * c - 0.06 * s)), 1e-12);
  EXPECT_NEAR(belief.map_T_eye.theta_rad, 0.4 + 0.5 * 0.23, 1e-12);
}

TEST(Motion, ExactArcAndManyEulerStepsAgree) {
  const LeverArm arm{0.15, 0.06, 0.2};
  EyeBelief exact = belief_at({1.0, 1.0, -1.0});
  EyeBelief euler = exact;
  predict(exact, {0.3, 0.5}, 2.0, arm, {}, true);
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    predict(euler, {0.3, 0.5}, 2.0 / kSteps, arm, {}, false);
  }
  EXPECT_NEAR(distance_m(exact.map_T_eye, euler.map_T_eye), 0.0, 1e-4);
}

TEST(Motion, TransitionIsThatOfDifferences) {
  const LeverArm arm;
  MotionNoise none{};
  none.v_share = none.v_floor_m_s = none.omega_share = none.omega_floor_rad_s = none.variance_floor = 0.0;
  for (const bool exact : {false, true}) {
    constexpr double kStep = 1e-6;
    const auto moved = [&](double dtheta) {
      EyeBelief belief = belief_at({1.0, 2.0, 0.5 + dtheta});
      predict(belief, {0.4, 0.6}, 0.7, arm, none, exact);
      return belief.map_T_eye;
    };
    EyeBelief belief;
    belief.map_T_eye = {1.0, 2.0, 0.5};
    belief.covariance(2, 2) = 1.0;
    predict(belief, {0.4, 0.6}, 0.7, arm, none, exact);
    EXPECT_NEAR(belief.covariance(0, 2), (moved(kStep).x_m - moved(-kStep).x_m) / (2 * kStep), 1e-7);
    EXPECT_NEAR(belief.covariance(1, 2), (moved(kStep).y_m - moved(-kStep).y_m) / (2 * kStep), 1e-7);
  }
}

TEST(Motion, RotatingOnTheSpotMovesTheEyeOnItsCircle) {
  const LeverArm arm{0.15, 0.06, 0.0};
  EyeBelief belief = belief_at(eye_from_base({0, 0, 0}, arm));
  predict(belief, {0.0, kPi / 2.0}, 1.0, arm, {}, true);
  EXPECT_NEAR(belief.map_T_eye.x_m, -0.06, 1e-12);
  EXPECT_NEAR(belief.map_T_eye.y_m, 0.15, 1e-12);
}

TEST(LeverArm, BaseAndEyeAreInverseWithTheirCovariances) {
  const LeverArm arm{0.2, -0.1, 0.3};
  const Pose2 base{1.0, -2.0, 0.8};
  const Matrix3 covariance = (Matrix3() << 0.02, 0.003, 0.001, 0.003, 0.01, -0.002, 0.001, -0.002, 0.005).finished();
  const Pose2 eye = eye_from_base(base, arm);
  EXPECT_NEAR(distance_m(base_from_eye(eye, arm), base), 0.0, 1e-12);
  EXPECT_LT((base_covariance(eye, eye_covariance(base, covariance, arm), arm) - covariance).norm(), 1e-12);
}

TEST(Measurement, StraightAheadIsHalfPi) {
  UncertainPoint point;
  point.p = {3.0, 0.0, 0.5};
  const RangeBearing seen = measure(point, 33.0, {.range_floor_m = 0.02, .bearing_floor_rad = 0.005});
  EXPECT_NEAR(seen.range_m, 3.0, 1e-12);
  EXPECT_NEAR(seen.beta_rad, kPi / 2.0, 1e-12);
  EXPECT_NEAR(seen.covariance(0, 0), 0.02 * 0.02, 1e-12);
}

TEST(Measurement, FartherIsLessCertain) {
  const StereoGeometry geometry;
  double before = 0.0;
  for (const double disparity_px : {100.0, 40.0, 20.0, 13.0}) {
    vision::StereoFeature feature;
    feature.left.u_px = 600.0F;
    feature.left.v_px = 384.0F;
    feature.disparity_px = disparity_px;
    const RangeBearing seen = measure(*triangulate(geometry, feature, {}), disparity_px, {});
    EXPECT_GT(seen.covariance(0, 0), before);
    before = seen.covariance(0, 0);
  }
}

TEST(Measurement, JacobianIsThatOfDifferences) {
  Rng rng(3);
  EyeBelief belief = belief_at({1.0, 2.0, 0.6}, 0.05, 0.03, 0.2);
  belief.disparity_offset_px = 0.1;
  const RangeBearing seen = sight_of({4.0, 3.5}, {1.02, 1.97, 0.62}, rng);
  const auto innovation = innovate(belief, seen);
  ASSERT_TRUE(innovation.has_value());
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 4; ++k) {
    EyeBelief more = belief;
    EyeBelief less = belief;
    double* of_more[] = {&more.map_T_eye.x_m, &more.map_T_eye.y_m, &more.map_T_eye.theta_rad,
                         &more.disparity_offset_px};
    double* of_less[] = {&less.map_T_eye.x_m, &less.map_T_eye.y_m, &less.map_T_eye.theta_rad,
                         &less.disparity_offset_px};
    *of_more[k] += kStep;
    *of_less[k] -= kStep;
    // The residual falls as the prediction rises.
    const Eigen::Vector2d slope = -(innovate(more, seen)->residual - innovate(less, seen)->residual) / (2 * kStep);
    EXPECT_LT((slope - innovation->jacobian.col(k)).norm(), 1e-7) << k;
  }
}

TEST(Measurement, OfALandmarkInTheEyeIsNothing) {
  Rng rng(3);
  const RangeBearing seen = sight_of({1.0, 2.0}, {0.0, 0.0, 0.0}, rng);
  EXPECT_FALSE(innovate(belief_at({1.0, 2.0, 0.3}), seen));
}

/// Mean normalised squared error of the pose after updates from random places: 3 where the filter is consistent.
double mean_nees(bool together, double offset_sigma_px) {
  Rng rng(together ? 11 : 12);
  double sum = 0.0;
  constexpr int kRuns = 600;
  for (int run = 0; run < kRuns; ++run) {
    const Pose2 truth{rng.uniform(2, 8), rng.uniform(2, 8), rng.uniform(-3, 3)};
    EyeBelief belief = belief_at(
        {truth.x_m + rng.normal(0.05), truth.y_m + rng.normal(0.05), wrap_angle(truth.theta_rad + rng.normal(0.03))},
        0.05, 0.03, offset_sigma_px);
    const double offset_px = rng.normal(offset_sigma_px);
    std::vector<RangeBearing> seen;
    for (int i = 0; i < 12; ++i) {
      const double bearing = truth.theta_rad + rng.uniform(-0.5, 0.5);
      const double range_m = rng.uniform(1.0, 6.0);
      const Point2 landmark = truth.translation() + range_m * Point2(std::cos(bearing), std::sin(bearing));
      RangeBearing one = sight_of(landmark, truth, rng);
      one.range_m += one.range_per_disparity_m * offset_px;
      seen.push_back(one);
    }
    static_cast<void>(together ? update_together(belief, seen, {3, 1e9}) : update_sequentially(belief, seen));
    const Eigen::Vector3d error(belief.map_T_eye.x_m - truth.x_m, belief.map_T_eye.y_m - truth.y_m,
                                wrap_angle(belief.map_T_eye.theta_rad - truth.theta_rad));
    sum += error.dot(belief.pose_covariance().inverse() * error);
  }
  return sum / kRuns;
}

// The 99 % band of a mean of 600 chi-squared values of 3 degrees of freedom is 2.75 .. 3.27.
TEST(Consistency, SequentialUpdateStatesItsError) {
  const double nees = mean_nees(false, 0.0);
  EXPECT_GT(nees, 2.75);
  EXPECT_LT(nees, 3.35) << "a little more is left for the linearisation";
}

TEST(Consistency, JointUpdateStatesItsError) {
  const double nees = mean_nees(true, 0.0);
  EXPECT_GT(nees, 2.7);
  EXPECT_LT(nees, 3.3);
}

TEST(Consistency, AnErrorThatAllDisparitiesShareIsAllowedFor) {
  const double nees = mean_nees(true, 0.5);
  EXPECT_GT(nees, 2.7);
  EXPECT_LT(nees, 3.3);
}

TEST(Update, OneWildMeasurementBarelyMovesTheJointUpdate) {
  Rng rng(9);
  const Pose2 truth{5.0, 5.0, 0.3};
  std::vector<RangeBearing> seen;
  for (int i = 0; i < 10; ++i) {
    seen.push_back(sight_of({8.0, 4.0 + 0.3 * i}, truth, rng));
  }
  seen.push_back(sight_of({8.0, 5.0}, truth, rng));
  seen.back().range_m += 1.0;
  EyeBelief belief = belief_at(truth);
  static_cast<void>(update_together(belief, seen, {}));
  EXPECT_LT(distance_m(belief.map_T_eye, truth), 0.06);
}

/// Random motions and measurements, good and bad.
void wander(EyeBelief& belief, bool together, int steps) {
  Rng rng(77);
  Pose2 truth{5.0, 5.0, 0.0};
  const LeverArm arm;
  for (int step = 0; step < steps; ++step) {
    const Twist2 velocity{rng.uniform(-0.3, 0.3), rng.uniform(-0.8, 0.8)};
    EyeBelief moved = belief_at(truth);
    predict(moved, velocity, 0.2, arm, {}, true);
    truth = moved.map_T_eye;
    predict(belief, velocity, 0.2, arm, {}, together);
    std::vector<RangeBearing> seen;
    for (std::uint64_t i = rng.below(4); i > 0; --i) {
      seen.push_back(sight_of({rng.uniform(0, 10), rng.uniform(0, 10)}, truth, rng, rng.uniform(0.001, 0.5)));
    }
    static_cast<void>(together ? update_together(belief, seen, {2, 2.5}) : update_sequentially(belief, seen));
    const Matrix3 covariance = belief.pose_covariance();
    ASSERT_EQ((covariance - covariance.transpose()).norm(), 0.0) << step;
    ASSERT_GT(Eigen::SelfAdjointEigenSolver<Matrix3>(covariance, Eigen::EigenvaluesOnly).eigenvalues().minCoeff(), 0.0)
        << step;
  }
}

TEST(Update, CovarianceStaysACovarianceForHundredThousandSteps) {
  EyeBelief joint = belief_at({5.0, 5.0, 0.0}, 0.05, 0.03, 0.2);
  ASSERT_NO_FATAL_FAILURE(wander(joint, true, 50'000));
  EyeBelief in_turn = belief_at({5.0, 5.0, 0.0});
  ASSERT_NO_FATAL_FAILURE(wander(in_turn, false, 50'000));
}

}  // namespace
}  // namespace seeker::localize
