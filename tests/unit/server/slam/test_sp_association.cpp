/// Which segment an observation is: gates, overlap, joint compatibility.
#include <gtest/gtest.h>

#include <algorithm>

#include "server/slam/sp_joint_search.hpp"
#include "sp_world.hpp"

namespace seeker::slam {
namespace {

using lines::SegmentObservation;
using test::SensorNoise;
using test::TrueWall;

constexpr SensorNoise kPrecise{0.002, 0.002, 0.01};

/// A map that has seen these walls from `pose` without error, ends real or not.
SpMap map_of(const std::vector<TrueWall>& walls, const Pose2& pose, const std::array<bool, 2>& real = {true, true},
             SpMapParams params = {}) {
  params.features.real_scans = 1;
  params.association.near_gate = params.association.gate;
  SpMap map(pose, 1e-8 * Matrix3::Identity(), params);
  std::vector<SegmentObservation> seen;
  for (const TrueWall& wall : walls) {
    seen.push_back(see(pose, wall, -0.5 * wall.length_m, 0.5 * wall.length_m, real, kPrecise, Vector4::Zero()));
  }
  map.update(seen, map.associate(seen));
  EXPECT_EQ(map.segments().size(), walls.size());
  return map;
}

SegmentObservation part_of(const Pose2& pose, const TrueWall& wall, double from_m, double to_m,
                           const std::array<bool, 2>& real = {false, false}) {
  return see(pose, wall, from_m, to_m, real, kPrecise, Vector4::Zero());
}

SegmentObservation whole(const Pose2& pose, const TrueWall& wall) {
  return part_of(pose, wall, -0.5 * wall.length_m, 0.5 * wall.length_m, {true, true});
}

TEST(Chi2Limit, IsCloseToTheTable) {
  // 99 % of spec S0.4, and of larger tables.
  EXPECT_NEAR(chi2_limit(2, 2.326), 9.210, 0.05);
  EXPECT_NEAR(chi2_limit(4, 2.326), 13.277, 0.05);
  EXPECT_NEAR(chi2_limit(20, 2.326), 37.566, 0.05);
  EXPECT_NEAR(chi2_limit(60, 1.645), 79.082, 0.05);
}

TEST(SpAssociation, RecognisesEveryWallOfTheRoom) {
  const std::vector<TrueWall> walls = test::room();
  const SpMap map = map_of(walls, {});
  std::vector<SegmentObservation> seen;
  for (const TrueWall& wall : walls) {
    seen.push_back(whole({}, wall));
  }
  const Association association = map.associate(seen);
  for (std::size_t k = 0; k < walls.size(); ++k) {
    EXPECT_EQ(association.matches[k].verdict, SpVerdict::kPaired);
    EXPECT_EQ(association.matches[k].segment, map.segments()[k].id);
    EXPECT_TRUE(association.matches[k].ends[0] && association.matches[k].ends[1]);
  }
  EXPECT_EQ(association.dof, 16);
  EXPECT_LT(association.joint_d2, 1e-9);
}

/// Four walls seen by a robot that is turned by so many deviations from where it is predicted; how many are recognised.
std::ptrdiff_t recognised_where_the_wheels_slipped(double sigmas) {
  constexpr double kSigma_rad = 0.005;
  SpMap map(Pose2{}, 1e-8 * Matrix3::Identity(), {});
  std::vector<SegmentObservation> seen;
  std::vector<SegmentObservation> seen_turned;
  const Pose2 turned{0.0, 0.0, sigmas * kSigma_rad};
  for (const TrueWall& wall : test::room()) {
    seen.push_back(whole({}, wall));
    seen_turned.push_back(whole(turned, wall));
  }
  map.update(seen, map.associate(seen));
  map.predict({}, Eigen::Vector3d(1e-6, 1e-6, kSigma_rad * kSigma_rad).asDiagonal());
  const Association association = map.associate(seen_turned);
  return std::count_if(association.matches.begin(), association.matches.end(),
                       [](const SpMatch& match) { return match.verdict == SpVerdict::kPaired; });
}

TEST(SpAssociation, RecognisesWallsThatAreAllOffAlikeForTheRobotIsOff) {
  EXPECT_EQ(recognised_where_the_wheels_slipped(2.0), 4);
  EXPECT_EQ(recognised_where_the_wheels_slipped(4.0), 4) << "each misses its gate alone";
  EXPECT_EQ(recognised_where_the_wheels_slipped(8.0), 0) << "this is no chance any more";
}

TEST(SpAssociation, TakesTheTwoFacesOfAWallForTwo) {
  const TrueWall north = test::wall_between({-2.0, 1.0}, {2.0, 1.0});
  const TrueWall south = test::wall_between({2.0, 0.98}, {-2.0, 0.98});
  const SpMap map = map_of({north}, {});
  const Association association = map.associate({whole({}, south)});
  EXPECT_EQ(association.matches[0].verdict, SpVerdict::kNew);
}

TEST(SpAssociation, AsksForOverlapOrASmallGapAtAVirtualEnd) {
  const TrueWall wall = test::wall_between({-10.0, 1.0}, {10.0, 1.0});
  const TrueWall part = test::wall_between({-1.0, 1.0}, {1.0, 1.0});
  const SpMap open = map_of({part}, {}, {false, false});
  const SpMap closed = map_of({part}, {}, {true, true});
  const auto verdict = [&](const SpMap& map, double from_m, double to_m) {
    return map.associate({part_of({}, wall, from_m, to_m)}).matches[0].verdict;
  };
  EXPECT_EQ(verdict(open, 0.5, 2.0), SpVerdict::kPaired);
  EXPECT_EQ(verdict(open, 1.4, 3.0), SpVerdict::kPaired);
  EXPECT_EQ(verdict(open, 1.6, 3.0), SpVerdict::kNew);
  EXPECT_EQ(verdict(closed, 1.1, 3.0), SpVerdict::kPaired);
  EXPECT_EQ(verdict(closed, 1.4, 3.0), SpVerdict::kNew);
  EXPECT_EQ(verdict(closed, -3.0, -1.4), SpVerdict::kNew);
}

TEST(SpAssociation, WhatLiesBesideASegmentIsPartOfItOnlyWhereTheirOffsetIsKnownWell) {
  const TrueWall wall = test::wall_between({-10.0, 1.0}, {10.0, 1.0});
  const TrueWall part = test::wall_between({-1.0, 1.0}, {1.0, 1.0});
  const auto verdict = [&](double merge_sigma_m, double from_m, double to_m) {
    SpMapParams params;
    params.features.merge_sigma_m = merge_sigma_m;
    const SpMap map = map_of({part}, {}, {false, false}, params);
    return map.associate({part_of({}, wall, from_m, to_m)}).matches[0].verdict;
  };
  EXPECT_EQ(verdict(0.0, 1.4, 3.0), SpVerdict::kPaired);
  EXPECT_EQ(verdict(0.02, 1.4, 3.0), SpVerdict::kPaired);
  EXPECT_EQ(verdict(0.003, 1.4, 3.0), SpVerdict::kRejected) << "known to 5 mm: neither part of it nor another";
  EXPECT_EQ(verdict(0.003, -1.0, 1.2), SpVerdict::kPaired) << "the segment itself";
}

TEST(SpAssociation, LetsAWallBeSeenInPiecesButNotTwice) {
  const TrueWall wall = test::wall_between({-3.0, 1.0}, {3.0, 1.0});
  const SpMap map = map_of({wall}, {});
  const Association pieces = map.associate({part_of({}, wall, -3.0, -0.5), part_of({}, wall, 0.5, 3.0)});
  EXPECT_EQ(pieces.matches[0].verdict, SpVerdict::kPaired);
  EXPECT_EQ(pieces.matches[1].verdict, SpVerdict::kPaired);
  const Association twice = map.associate({part_of({}, wall, -3.0, 0.5), part_of({}, wall, -0.5, 3.0)});
  EXPECT_NE(twice.matches[0].verdict == SpVerdict::kPaired, twice.matches[1].verdict == SpVerdict::kPaired);
}

TEST(SpAssociation, LeavesOutAnEndThatDisagrees) {
  const TrueWall wall = test::wall_between({-2.0, 1.0}, {2.0, 1.0});
  const SpMap map = map_of({wall}, {});
  const Association association = map.associate({part_of({}, wall, -2.0, 1.5, {true, true})});
  ASSERT_EQ(association.matches[0].verdict, SpVerdict::kPaired);
  EXPECT_TRUE(association.matches[0].ends[lines::kLeft]);
  EXPECT_FALSE(association.matches[0].ends[lines::kRight]);
}

TEST(SpAssociation, LeavesOutAnEndThatOnlySomeBeamsWouldShow) {
  const TrueWall wall = test::wall_between({-2.0, 1.0}, {2.0, 1.0});
  const SpMap map = map_of({wall}, {});
  SegmentObservation seen = whole({}, wall);
  seen.foot_x_m = -1.0;
  seen.clear_m = 2.5;
  const Association association = map.associate({seen});
  ASSERT_EQ(association.matches[0].verdict, SpVerdict::kPaired);
  EXPECT_TRUE(association.matches[0].ends[lines::kLeft]) << "1 m from the foot";
  EXPECT_FALSE(association.matches[0].ends[lines::kRight]) << "3 m from it";
}

/// Two parallel walls 0.4 m apart (a door niche) and a cross wall. The robot slipped sideways by more than half
/// of that: the nearest wall is the wrong one, but then the two do not keep their distance.
struct Niche {
  std::vector<TrueWall> walls{test::wall_between({-2.0, 2.0}, {0.0, 2.0}), test::wall_between({-2.0, 2.4}, {0.0, 2.4}),
                              test::wall_between({3.0, 2.0}, {3.0, -2.0})};
  Pose2 truth{0.0, 0.25, 0.0};  ///< the map believes (0, 0, 0)

  [[nodiscard]] SpMap map(SpAssociationMethod method) const {
    SpMapParams params;
    params.association.method = method;
    SpMap map = map_of(walls, {}, {false, false}, params);
    map.predict({}, Eigen::Vector3d(0.01, 0.04, 1e-6).asDiagonal().toDenseMatrix());
    return map;
  }
  [[nodiscard]] std::vector<SegmentObservation> seen() const {
    return {whole(truth, walls[0]), whole(truth, walls[1]), whole(truth, walls[2])};
  }
};

TEST(SpAssociation, JointCompatibilityIsRightWhereTheNearestNeighbourIsWrong) {
  const Niche niche;
  const SpMap joint = niche.map(SpAssociationMethod::kJoint);
  const Association together = joint.associate(niche.seen());
  EXPECT_EQ(together.matches[0].segment, joint.segments()[0].id);
  EXPECT_EQ(together.matches[1].segment, joint.segments()[1].id);
  EXPECT_FALSE(together.capped);
  const SpMap nearest = niche.map(SpAssociationMethod::kNearestNeighbour);
  const Association alone = nearest.associate(niche.seen());
  EXPECT_EQ(alone.matches[1].segment, nearest.segments()[0].id) << "the far wall, 0.15 m from where the near one is";
}

TEST(SpAssociation, KeepsTheGreedyAnswerWhenTheSearchIsCutOff) {
  const Niche niche;
  SpMapParams params;
  params.association.max_nodes = 1;
  SpMap map = map_of(niche.walls, {}, {false, false}, params);
  map.predict({}, Eigen::Vector3d(0.01, 0.04, 1e-6).asDiagonal().toDenseMatrix());
  const Association association = map.associate(niche.seen());
  EXPECT_TRUE(association.capped);
  EXPECT_LE(association.nodes, 8);
  EXPECT_EQ(association.matches[2].verdict, SpVerdict::kPaired);
}

TEST(SpAssociation, NothingNewIsBegunBesideAnOldSegment) {
  const TrueWall wall = test::wall_between({-2.0, 1.0}, {2.0, 1.0});
  const TrueWall beside = test::wall_between({-2.0, 1.012}, {2.0, 1.012});
  const TrueWall apart = test::wall_between({-2.0, 1.3}, {2.0, 1.3});
  SpMap map({}, 1e-8 * Matrix3::Identity());
  const std::vector<SegmentObservation> first{whole({}, wall)};
  map.update(first, map.associate(first));
  const Association association = map.associate({whole({}, beside), whole({}, apart)});
  EXPECT_EQ(association.matches[0].verdict, SpVerdict::kRejected);
  EXPECT_GT(association.matches[0].d2, 5.991);
  EXPECT_EQ(association.matches[1].verdict, SpVerdict::kNew);
}

TEST(SpAssociation, RefusesObservationsThatAreNone) {
  const TrueWall wall = test::wall_between({-2.0, 1.0}, {2.0, 1.0});
  SpMap map = map_of({wall}, {});
  std::vector<SegmentObservation> bad(4, whole({}, wall));
  bad[0].length_m = 0.0;
  bad[1].base_T_segment.x_m = NAN;
  bad[2].covariance(0, 1) = bad[2].covariance(1, 0) = 1.0;
  bad[3].end_sigma_m[0] = NAN;
  const Association association = map.associate(bad);
  for (const SpMatch& match : association.matches) {
    EXPECT_EQ(match.verdict, SpVerdict::kRejected);
  }
  EXPECT_EQ(map.update(bad, association).rejected, 4);
  EXPECT_EQ(map.segments().size(), 1U);
}

}  // namespace
}  // namespace seeker::slam
