#include "server/slam/map_backend.hpp"

#include <gtest/gtest.h>

#include "tests/support/matchers.hpp"
#include "tests/unit/server/slam/visit.hpp"

namespace seeker::slam {
namespace {

using testing::Pose2Near;

/// Covariance of the motion from one local map to the next, of a robot whose odometry is worse than this says.
const Matrix3 kMotion = Eigen::Vector3d(6e-3, 6e-3, 1e-4).asDiagonal();
const Matrix3 kSure = Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal();
/// Of a place that was found: RelocaliseParams::joint_sigma_m and joint_sigma_rad.
const Matrix3 kFound = Eigen::Vector3d(9e-4, 9e-4, 1e-4).asDiagonal();
constexpr int kView = 8;  // LoopPolicy::query_keyframes

const Pose2 kFirst{2.0, 2.5, 0.0};

/// Localises only, in a map of one view of the room from kFirst; where it is there is not known yet.
MapBackend in_a_loaded_map(Visit& visit) {
  MapBackend mapper;
  mapper.begin_first(kFirst, visit.now());
  visit.look(mapper, kFirst, 10);
  MapBackend backend;
  backend.load(mapper.assemble(1), MapUse::kLocalise);
  backend.begin_apart(visit.now());
  return backend;
}

void compare(MapBackend& backend) {
  backend.plan_loops({});
  for (int scan = 0; scan < 4; ++scan) {
    backend.step_loops();
  }
}

TEST(MapBackend, OneViewIsOneWitnessHoweverManyLocalMapsItIsComparedWith) {
  Visit visit(1);
  MapBackend backend;
  const Pose2 second{2.8, 3.2, 0.4};
  const Pose2 turning_point{6.0, 3.0, 0.0};
  const Pose2 back{2.4, 2.8, 0.2};
  backend.begin_first(kFirst, visit.now());
  visit.look(backend, kFirst, 10);
  backend.begin_next(inverse(kFirst) * second, kMotion, visit.now());
  visit.look(backend, second, 10);
  backend.begin_next(inverse(second) * turning_point, kMotion, visit.now());
  const std::uint32_t newest =
      backend.begin_next(inverse(turning_point) * back * Pose2{0.7, 0.0, 0.0}, kMotion, visit.now());
  visit.look(backend, back, kView);
  compare(backend);
  EXPECT_EQ(backend.loops().surprises, 2) << "both local maps show where the robot is";
  EXPECT_EQ(backend.loops().closed, 0) << "the same scans twice";
  visit.look(backend, back, kView / 2);
  compare(backend);
  EXPECT_EQ(backend.loops().surprises, 4);
  EXPECT_EQ(backend.loops().closed, 0) << "half of the scans are those of the first view";
  visit.look(backend, back, kView / 2);
  compare(backend);
  EXPECT_GT(backend.loops().closed, 1) << "what agrees comes along";
  EXPECT_THAT(backend.pose(newest), Pose2Near(back, 0.05, 0.02));
}

TEST(MapBackend, WhatALoadedMapShowsIsNoViewOfARobotThatWasJustFound) {
  Visit visit(2);
  MapBackend mapper;
  mapper.begin_first(kFirst, visit.now());
  visit.look(mapper, kFirst, 10);
  for (const Pose2& next : {Pose2{2.8, 3.2, 0.4}, Pose2{7.5, 2.0, 2.0}}) {
    mapper.begin_next(inverse(mapper.pose(mapper.newest().id)) * next, kSure, visit.now());
    visit.look(mapper, next, 10);
  }
  for (const MapUse use : {MapUse::kContinue, MapUse::kLocalise}) {
    MapBackend backend;
    backend.load(mapper.assemble(3), use);
    backend.begin_apart(visit.now());
    backend.anchor({6.5, 2.0, 0.3}, kSure);
    compare(backend);
    EXPECT_GT(backend.loops().tried, 0);
    EXPECT_EQ(backend.loops().surprises + backend.loops().closed, 0) << "it has not seen anything yet";
  }
}

TEST(MapBackend, LoopsThatAgreeOverruleWhereTheRobotWasJoinedAndWhatItHasDropped) {
  const Pose2 truth{2.4, 2.8, 0.2};
  for (const int dropped : {0, 6}) {
    Visit visit(4);
    MapBackend mapper;
    mapper.begin_first(kFirst, visit.now());
    visit.look(mapper, kFirst, 10);
    mapper.begin_next(inverse(kFirst) * Pose2{2.8, 3.2, 0.4}, kSure, visit.now());
    visit.look(mapper, {2.8, 3.2, 0.4}, 10);
    MapBackend backend;
    backend.load(mapper.assemble(2), MapUse::kLocalise);
    backend.begin_apart(visit.now());
    backend.anchor(truth * Pose2{0.7, -0.3, 0.0}, kFound);
    for (int k = 0; k < dropped; ++k) {
      backend.begin_next({}, 0.1 * kSure, visit.now());
    }
    visit.look(backend, truth, kView);
    compare(backend);
    EXPECT_EQ(backend.loops().closed, 0) << "one view may be wrong";
    visit.look(backend, truth, kView);
    compare(backend);
    EXPECT_GT(backend.loops().closed, 0);
    EXPECT_THAT(backend.pose(backend.newest().id), Pose2Near(truth, 0.05, 0.02)) << dropped << " dropped";
  }
}

TEST(MapBackend, EachViewThatContradictsAMapThatIsOnlyReadCountsOnce) {
  const Pose2 truth{2.4, 2.8, 0.2};
  Visit visit(5);
  MapBackend backend = in_a_loaded_map(visit);
  backend.anchor(kFirst * Pose2{2.0, 1.5, 2.0}, kFound);
  for (int views = 1; views <= 3; ++views) {
    visit.look(backend, truth, kView);
    compare(backend);
    compare(backend);
    EXPECT_EQ(backend.loops().contradictions, views);
  }
  backend.begin_apart(visit.now());
  EXPECT_EQ(backend.loops().contradictions, 0);
  backend.anchor(truth, kFound);
  visit.look(backend, truth, kView);
  compare(backend);
  EXPECT_GT(backend.loops().closed, 0);
  EXPECT_EQ(backend.loops().contradictions, 0) << "it is where it was found";
}

TEST(MapBackend, ARobotThatOnlyReadsKeepsWhatItKnowsOfItsPlaceWhenItDropsItsLocalMaps) {
  Visit visit(3);
  MapBackend backend = in_a_loaded_map(visit);
  backend.anchor({2.5, 2.5, 0.1}, kSure);
  const Matrix3 step = Eigen::Vector3d(4e-4, 4e-4, 1e-4).asDiagonal();
  UncertainPose expected{{2.5, 2.5, 0.1}, kSure};
  for (int k = 0; k < 40; ++k) {
    const Pose2 driven{k % 2 == 0 ? 0.3 : -0.3, 0.0, 0.0};
    expected = compose(expected, {driven, step});
    backend.begin_next(driven, step, visit.now());
    ASSERT_LE(backend.maps().size(), 3U) << "the loaded one and two of its own";
    ASSERT_EQ(backend.newest().id + 1U, backend.maps().size());
  }
  EXPECT_THAT(backend.pose(backend.newest().id), Pose2Near(expected.a_T_b, 1e-9, 1e-9));
  EXPECT_LT((backend.newest_covariance() - expected.covariance).norm(), 1e-6 * expected.covariance.norm());
  // A loop is weighed against all that was driven since: it puts the robot right, and the covariance shrinks.
  const Pose2 truth = expected.a_T_b * Pose2{0.05, -0.06, 0.02};
  visit.look(backend, truth, kView);
  const double before = backend.newest_covariance().trace();
  compare(backend);
  EXPECT_GT(backend.loops().closed, 0);
  EXPECT_LT(backend.newest_covariance().trace(), 0.1 * before);
  EXPECT_THAT(backend.pose(backend.newest().id), Pose2Near(truth, 0.05, 0.02));
}

}  // namespace
}  // namespace seeker::slam
