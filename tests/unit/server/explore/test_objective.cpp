#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <Eigen/LU>

#include "scenes.hpp"
#include "server/explore/objective.hpp"

namespace seeker::explore {
namespace {

using test::filter_of;
using test::kNorth;
using test::moved;
using test::wall;

/// A corner of a room whose walls go on to the left and to the right.
std::vector<MapSegment> corner() {
  return {wall({-2.0, 2.0}, {1.5, 2.0}, {false, true}), wall({1.5, 2.0}, {1.5, -1.0}, {true, false})};
}

std::vector<PredictedMotion> some_motions() {
  std::vector<PredictedMotion> motions;
  for (const double v_m_s : {0.0, 0.1}) {
    for (const double omega_rad_s : {-0.17, 0.0, 0.17}) {
      motions.push_back(predict_motion({v_m_s, omega_rad_s}, 4.0, {}));
    }
  }
  return motions;
}

std::vector<Terms> terms_of(const std::vector<MapSegment>& walls, const Belief& belief, const Pose2& map_T_base) {
  const SightScene scene(walls, map_T_base.translation(), 7.0, {});
  return evaluate(map_T_base, some_motions(), scene, belief, {});
}

TEST(Objective, SumsRunOverTheWholeMapWhereTheyAreToBeAsPrinted) {
  std::vector<MapSegment> walls = corner();
  walls.push_back(wall({100.0, 2.0}, {113.5, 2.0}));  // out of reach
  OneStepParams params;
  const SightScene scene(walls, {0.0, 0.0}, 7.0, params);
  const Growth growth{1.0, 1.0, {}};
  const Terms around = combine(1.0, 2.0, growth, scene, params);
  EXPECT_NEAR(around.j21, 1.0 / 6.5, 1e-12);
  EXPECT_NEAR(around.j22, 1.0 / 4.0, 1e-12);
  params.all_segments = true;
  const Terms all = combine(1.0, 2.0, growth, scene, params);
  EXPECT_NEAR(all.j21, 1.0 / 20.0, 1e-12);
  EXPECT_NEAR(all.j22, 1.0 / 6.0, 1e-12);
}

double robot_size(const PredictedBelief& belief) { return std::sqrt(belief.robot_covariance().determinant()); }

TEST(Objective, MotionIsTheControlsArcAndItsNoiseGrows) {
  const PredictedMotion half = predict_motion({0.15, 0.17}, 2.0, {});
  const PredictedMotion whole = predict_motion({0.15, 0.17}, 4.0, {});
  const Pose2 arc = integrate({0.15, 0.17}, 4.0);
  EXPECT_NEAR(whole.increment.x_m, arc.x_m, 1e-12);
  EXPECT_NEAR(whole.increment.y_m, arc.y_m, 1e-12);
  EXPECT_NEAR(whole.increment.theta_rad, 0.68, 1e-12);
  EXPECT_GT(whole.covariance.determinant(), half.covariance.determinant());
  EXPECT_NEAR(whole.covariance(2, 2), 2.0 * half.covariance(2, 2), 1e-12);
}

TEST(Objective, SeeingAWallMakesTheRobotAndTheWallMoreCertain) {
  const std::vector<MapSegment> walls = corner();
  const Pose2 pose{0.0, 0.0, kNorth};
  const slam::SpMap filter = filter_of(walls, pose);
  const Belief belief(slam::LocalBelief{&filter, {}});
  const SightScene scene(walls, pose.translation(), 7.0, {});
  PredictedBelief then = belief.joint({0, 1});
  const double before = robot_size(then);
  const double all_before = then.uncertainty();
  const std::vector<PredictedSight> sights = predict_sights(belief, scene.look(pose), 32);
  ASSERT_EQ(sights.size(), 2U);
  then.observe(belief, pose, sights, {});
  EXPECT_LT(robot_size(then), 0.2 * before);
  EXPECT_LT(then.uncertainty(), all_before);
}

TEST(Objective, DrivingBlindMakesTheRobotLessCertain) {
  const slam::SpMap filter = filter_of(corner(), {0.0, 0.0, kNorth});
  const Belief belief(slam::LocalBelief{&filter, {}});
  PredictedBelief then = belief.joint({0, 1});
  const double before = then.uncertainty();
  then.move(predict_motion({0.15, 0.0}, 4.0, {}));
  EXPECT_GT(then.uncertainty(), before);
}

TEST(Objective, WallsOutsideTheJointCountAsTheyAre) {
  const slam::SpMap filter = filter_of(corner(), {0.0, 0.0, kNorth});
  const Belief belief(slam::LocalBelief{&filter, {}});
  EXPECT_NEAR(belief.joint({}).uncertainty(), belief.joint({0, 1}).uncertainty(), 1e-12);
  EXPECT_NEAR(belief.joint({1}).uncertainty(), belief.joint({1, 0}).uncertainty(), 1e-12);
}

TEST(Objective, AgreesWithTheFilterItself) {
  // The prediction of a motion and of a look is what the filter then does, apart from its floor and its drift.
  const Pose2 pose{0.0, 0.0, kNorth};
  const std::vector<MapSegment> walls{wall({-1.0, 2.0}, {1.0, 2.0}, {true, true})};
  slam::SpMap filter = filter_of(walls, pose);
  const Belief belief(slam::LocalBelief{&filter, {}});
  SensorModel sensor;
  PredictedBelief then = belief.joint({0});
  const PredictedMotion motion = predict_motion({0.1, 0.05}, 4.0, {});
  const Pose2 next = pose * motion.increment;
  then.move(motion);
  const SightScene scene(walls, pose.translation(), 7.0, {});
  const std::vector<PredictedSight> sights = predict_sights(belief, scene.look(next), 32);
  ASSERT_EQ(sights.size(), 1U);
  then.observe(belief, next, sights, sensor);

  filter.predict(motion.increment, motion.covariance);
  lines::SegmentObservation seen;
  const SeenPart& part = sights[0].part;
  seen.base_T_segment = inverse(next) * walls[0].map_T_segment * Pose2{0.5 * (part.from_m + part.to_m), 0.0, 0.0};
  seen.length_m = part.to_m - part.from_m;
  seen.real = part.ends;
  const double scale = static_cast<double>(sensor.nominal_points) / part.beams;
  seen.covariance = scale * Eigen::Vector2d(sensor.sigma_y_m, sensor.sigma_theta_rad).cwiseAbs2().asDiagonal();
  const double end_sigma_m = sensor.sigma_end_m * std::sqrt(scale);
  seen.end_sigma_m = {end_sigma_m, end_sigma_m};
  seen.points = part.beams;
  slam::Association association;
  association.matches.push_back({slam::SpVerdict::kPaired, filter.segments()[0].id, 0.0, part.ends});
  filter.update({seen}, association);
  EXPECT_TRUE(then.robot_covariance().isApprox(filter.robot_covariance(), 1e-3)) << then.robot_covariance() << "\n\n"
                                                                                 << filter.robot_covariance();
}

TEST(Objective, PrefersTheViewThatLengthensASegment) {
  const std::vector<MapSegment> walls{wall({-2.0, 2.0}, {1.0, 2.0}, {true, false})};
  const Pose2 pose{0.0, 0.0, deg_to_rad(150.0)};
  const slam::SpMap filter = filter_of(walls, pose);
  const std::vector<Terms> terms = terms_of(walls, Belief(slam::LocalBelief{&filter, {}}), pose);
  EXPECT_GT(terms[0].j21, terms[2].j21) << "turning right shows more of the open end on the right";
  EXPECT_GT(terms[0].score, terms[2].score);
  EXPECT_EQ(terms[2].lg_j21, -3.0) << "nothing to gain is the floor of the logarithm";
}

TEST(Objective, AnEmptyMapGivesFiniteTerms) {
  const slam::SpMap filter({}, Matrix3::Zero());
  for (const Terms& terms : terms_of({}, Belief(slam::LocalBelief{&filter, {}}), {})) {
    EXPECT_TRUE(std::isfinite(terms.score));
    EXPECT_TRUE(terms.gains_nothing(1e-3));
  }
}

TEST(Objective, WorksWithoutAFilterOfLines) {
  const Pose2 pose{0.0, 0.0, kNorth};
  const Belief belief(pose, 1e-3 * Matrix3::Identity(), corner(), 100);
  const SightScene scene(corner(), pose.translation(), 7.0, {});
  PredictedBelief then = belief.joint({0, 1});
  const double before = robot_size(then);
  then.observe(belief, pose, predict_sights(belief, scene.look(pose), 32), {});
  EXPECT_LT(robot_size(then), before);
}

/// Random walls around the origin, on a lattice that no threshold in metres lies on.
std::vector<MapSegment> any_walls() {
  std::vector<MapSegment> walls;
  const int count = *rc::gen::inRange(1, 12);
  for (int k = 0; k < count; ++k) {
    const auto metres = [] { return 0.0101237 * *rc::gen::inRange(-500, 500); };
    const Point2 left(metres(), metres());
    const double heading_rad = 0.01 * *rc::gen::inRange(-314, 314);
    const double length_m = 0.0101237 * *rc::gen::inRange(30, 400);
    const Point2 right = left + length_m * Point2(std::cos(heading_rad), std::sin(heading_rad));
    walls.push_back(wall(left, right, {*rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>()}));
  }
  return walls;
}

RC_GTEST_PROP(ObjectiveProperty, LookingNeverRaisesADeterminant, ()) {
  const std::vector<MapSegment> walls = any_walls();
  const slam::SpMap filter = filter_of(walls, {});
  const Belief belief(slam::LocalBelief{&filter, {}});
  const Pose2 pose{0.01 * *rc::gen::inRange(-300, 300), 0.01 * *rc::gen::inRange(-300, 300),
                   0.01 * *rc::gen::inRange(-314, 314)};
  const SightScene scene(walls, pose.translation(), 7.0, {});
  std::vector<std::size_t> all(belief.walls().size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k] = k;
  }
  PredictedBelief then = belief.joint(all);
  const double robot = robot_size(then);
  const double sum = then.uncertainty();
  then.observe(belief, pose, predict_sights(belief, scene.look(pose), *rc::gen::inRange(0, 12)), {});
  RC_ASSERT(robot_size(then) <= robot * (1.0 + 1e-9));
  RC_ASSERT(then.uncertainty() <= sum * (1.0 + 1e-9));
}

RC_GTEST_PROP(ObjectiveProperty, TermsDoNotDependOnWhereTheMapsOriginIs, ()) {
  const std::vector<MapSegment> walls = any_walls();
  const slam::SpMap filter = filter_of(walls, {});
  const Pose2 by{0.1 * *rc::gen::inRange(-500, 500), 0.1 * *rc::gen::inRange(-500, 500),
                 0.01 * *rc::gen::inRange(-314, 314)};
  const Pose2 pose{0.317, -0.211, 0.523};
  const std::vector<Terms> here = terms_of(walls, Belief(slam::LocalBelief{&filter, {}}), pose);
  const std::vector<Terms> there = terms_of(moved(walls, by), Belief(slam::LocalBelief{&filter, by}), by * pose);
  for (std::size_t k = 0; k < here.size(); ++k) {
    RC_ASSERT(std::abs(here[k].lg_j1 - there[k].lg_j1) < 1e-4);
    RC_ASSERT(std::abs(here[k].j21 - there[k].j21) < 1e-4);
    RC_ASSERT(here[k].j22 == there[k].j22);
  }
}

}  // namespace
}  // namespace seeker::explore
