#include "server/slam/global_matcher.hpp"

#include <gtest/gtest.h>

#include "rooms.hpp"
#include "server/slam/map_agreement.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::slam {
namespace {

using testing::Pose2Near;

std::vector<OrientedPoint> room_points(Rng& rng) {
  std::vector<OrientedPoint> points;
  for (const Pose2& pose : {Pose2{2.5, 3.0, 0.0}, Pose2{8.0, 2.0, 1.0}, Pose2{6.0, 3.0, -2.0}, Pose2{9.0, 5.0, 0.0}}) {
    const SeenPoints seen = transform(pose, seen_points(scan_at(furnished_room(), pose, 0.0, rng, kTwoPi)));
    points.insert(points.end(), seen.points.begin(), seen.points.end());
  }
  return points;
}

TEST(LikelihoodPyramid, EachLevelBoundsTheCellsOfItsBlock) {
  Rng rng(1);
  const auto map = LikelihoodPyramid::build(room_points(rng));
  ASSERT_TRUE(map);
  for (int k = 0; k < 20000; ++k) {
    const int i = static_cast<int>(rng.below(static_cast<std::uint64_t>(map->width()))) - 3;
    const int j = static_cast<int>(rng.below(static_cast<std::uint64_t>(map->height()))) - 3;
    const int direction = static_cast<int>(rng.below(8));
    int most = 0;
    for (int d = 0; d < 16; ++d) {
      most = std::max<int>(most, map->value(0, direction, i + d % 4, j + d / 4));
    }
    EXPECT_EQ(map->value(2, direction, i, j), i < 0 || j < 0 ? 0 : most);
  }
}

TEST(LikelihoodPyramid, TheSumsOfBlocksBoundEveryPoseInThem) {
  Rng rng(2);
  const auto map = LikelihoodPyramid::build(room_points(rng));
  ASSERT_TRUE(map);
  const int block = 1 << map->coarse_level();
  for (int k = 0; k < 300; ++k) {
    const CellIndex first{static_cast<int>(rng.below(500)) - 250, static_cast<int>(rng.below(400)) - 200};
    const int direction = static_cast<int>(rng.below(8));
    LikelihoodPyramid::BlockSums sums(7, 5);
    map->add_blocks(direction, first, sums);
    for (int row = 0; row < sums.rows; ++row) {
      for (int column = 0; column < sums.columns; ++column) {
        int most = 0;
        for (int d = 0; d < block * block; ++d) {
          most = std::max<int>(
              most, map->value(0, direction, first.i + column * block + d % block, first.j + row * block + d / block));
        }
        ASSERT_EQ(sums.at(column, row), most) << first.i << " " << first.j << " " << column << " " << row;
      }
    }
  }
}

TEST(LikelihoodPyramid, AWallSeenFromItsOtherSideDoesNotFit) {
  std::vector<OrientedPoint> wall;
  for (int k = 0; k < 100; ++k) {
    wall.push_back({{0.05 * k, 0.0}, {0.0, 1.0}});
  }
  const auto map = LikelihoodPyramid::build(wall);
  ASSERT_TRUE(map);
  EXPECT_GT(map->value({2.0, 0.0}, map->direction_of(kPi / 2.0)), 200);
  EXPECT_EQ(map->value({2.0, 0.0}, map->direction_of(-kPi / 2.0)), 0);
  EXPECT_EQ(map->value({2.0, 0.5}, map->direction_of(kPi / 2.0)), 0);
  EXPECT_EQ(map->direction_of(-kPi / 2.0), map->direction_of(1.5 * kPi));
}

TEST(LikelihoodPyramid, RefusesWhatWouldNotFitIntoMemory) {
  EXPECT_EQ(LikelihoodPyramid::build({}).error().code, Errc::kInvalidArgument);
  const OrientedPoint here{{0.0, 0.0}, {1.0, 0.0}};
  EXPECT_EQ(LikelihoodPyramid::build({here, {{1e12, 0.0}, {1.0, 0.0}}}).error().code, Errc::kTooLarge);
  EXPECT_EQ(LikelihoodPyramid::build({here, {{2000.0, 2000.0}, {1.0, 0.0}}}).error().code, Errc::kTooLarge);
  EXPECT_EQ(LikelihoodPyramid::build({here, {{std::nan(""), 0.0}, {1.0, 0.0}}}).error().code, Errc::kInvalidArgument);
}

TEST(LikelihoodPyramid, RefusesParametersThatMakeNoGrid) {
  for (const int level : {0, 9}) {
    PyramidParams params;
    params.coarse_level = level;
    EXPECT_EQ(LikelihoodPyramid::build({{{0.0, 0.0}, {1.0, 0.0}}}, params).error().code, Errc::kInvalidArgument);
  }
  PyramidParams flat;
  flat.resolution_m = 0.0;
  EXPECT_FALSE(LikelihoodPyramid::build({{{0.0, 0.0}, {1.0, 0.0}}}, flat));
}

TEST(GlobalMatcher, FindsTheBestPoseOfItsLatticeAsExhaustiveSearchDoes) {
  Rng rng(3);
  const auto map = LikelihoodPyramid::build(room_points(rng));
  ASSERT_TRUE(map);
  GlobalSearchParams params;
  params.max_points = 40;
  params.max_candidates = 1;
  params.leaf_level = 0;
  const auto points = seen_points(scan_at(furnished_room(), {4.5, 3.5, 0.8}, 0.0, rng)).points;
  const SearchWindow window{{4.3, 3.3, 0.7}, 0.5, 0.2};
  const auto found = GlobalMatcher(params).search(*map, points, window);
  ASSERT_EQ(found.candidates.size(), 1U);
  const auto thin = thin_by_cells(points, params.thin_cell_m, params.max_points);
  double best = 0.0;
  for (double heading = 0.7 - 0.2; heading < 0.9; heading += 0.005) {
    for (double y = 2.8; y < 3.8; y += 0.05) {
      for (double x = 3.8; x < 4.8; x += 0.05) {
        double sum = 0.0;
        for (const OrientedPoint& point : thin) {
          const OrientedPoint p = transform(Pose2{x, y, heading}, point);
          sum += map->value(p.p, map->direction_of(std::atan2(p.normal.y(), p.normal.x())));
        }
        best = std::max(best, sum / 255.0 / static_cast<double>(thin.size()));
      }
    }
  }
  // The lattices differ by half a cell and half a step.
  EXPECT_NEAR(found.candidates.front().score, best, 0.08);
  const Pose2 truth{4.5, 3.5, 0.8};
  EXPECT_THAT(found.candidates.front().map_T_base, Pose2Near(truth, 0.08, 0.04));
}

TEST(GlobalMatcher, FindsAScanAnywhereInTheRoomWithAnyHeading) {
  Rng rng(4);
  const auto map = LikelihoodPyramid::build(room_points(rng));
  ASSERT_TRUE(map);
  for (int k = 0; k < 20; ++k) {
    const Pose2 truth{rng.uniform(1.5, 3.5), rng.uniform(1.5, 4.5), rng.uniform(-kPi, kPi)};
    const auto points = seen_points(scan_at(furnished_room(), truth, 0.0, rng, kTwoPi)).points;
    const auto found = GlobalMatcher().search(*map, points);
    ASSERT_FALSE(found.candidates.empty()) << truth;
    EXPECT_THAT(found.candidates.front().map_T_base, Pose2Near(truth, 0.15, 0.05)) << truth;
    EXPECT_TRUE(found.complete);
  }
}

TEST(GlobalMatcher, CandidatesAreDistinctAndInOrder) {
  Rng rng(5);
  const auto map = LikelihoodPyramid::build(room_points(rng));
  ASSERT_TRUE(map);
  GlobalSearchParams params;
  params.rival_ratio = 0.4;
  const auto points = seen_points(scan_at(furnished_room(), {3.0, 3.0, 2.0}, 0.0, rng)).points;
  const auto list = GlobalMatcher(params).search(*map, points).candidates;
  ASSERT_GT(list.size(), 1U);
  EXPECT_LE(list.size(), params.max_candidates);
  for (std::size_t a = 0; a < list.size(); ++a) {
    for (std::size_t b = a + 1; b < list.size(); ++b) {
      EXPECT_GE(list[a].score, list[b].score);
      EXPECT_TRUE(distance_m(list[a].map_T_base, list[b].map_T_base) > params.distinct_m ||
                  std::abs(wrap_angle(list[a].map_T_base.theta_rad - list[b].map_T_base.theta_rad)) >
                      params.distinct_rad);
    }
  }
}

TEST(GlobalMatcher, NothingToSearchWithOrForGivesNoCandidate) {
  Rng rng(6);
  const auto map = LikelihoodPyramid::build(room_points(rng));
  ASSERT_TRUE(map);
  EXPECT_TRUE(GlobalMatcher().search(*map, {}).candidates.empty());
  const auto points = seen_points(scan_at(furnished_room(), {3.0, 3.0, 0.0}, 0.0, rng)).points;
  const SearchWindow elsewhere{{200.0, -300.0, 0.0}, 4.0, 0.5};
  EXPECT_TRUE(GlobalMatcher().search(*map, points, elsewhere).candidates.empty());
  GlobalSearchParams hasty;
  hasty.max_expansions = 3;
  EXPECT_FALSE(GlobalMatcher(hasty).search(*map, points).complete);
}

}  // namespace
}  // namespace seeker::slam
