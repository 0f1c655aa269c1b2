#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "ascii_map.hpp"
#include "common/core/rng.hpp"
#include "server/nav/cost_map.hpp"
#include "server/nav/distance_transform.hpp"
#include "server/nav/planner.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::nav {
namespace {

/// Two rooms of about 4 x 3 m, a wall of 0.1 m between them, a door of 0.9 m.
Grid<std::uint8_t> two_rooms() {
  std::vector<std::string> rows(30, '#' + std::string(78, '.') + '#');
  rows.front() = rows.back() = std::string(80, '#');
  for (std::size_t j = 1; j < 29; ++j) {
    if (j < 10 || j >= 19) {
      rows[j][40] = '#';
    }
  }
  return ascii_map(rows, 0.1);
}

CostMap map_of(const Grid<std::uint8_t>& occupancy, const CostMapLimits& limits = {},
               const CostMapParams& params = {}) {
  auto map = CostMap::build(occupancy, params, limits);
  EXPECT_TRUE(map);
  return *map;
}

double smallest_clearance(const CostMap& map, const Path& path) {
  double smallest = 1e9;
  for (std::size_t k = 1; k < path.waypoints.size(); ++k) {
    const Point2 step = path.waypoints[k] - path.waypoints[k - 1];
    for (double t = 0.0; t <= 1.0; t += 0.01) {
      const Point2 p = path.waypoints[k - 1] + t * step;
      smallest = std::min(smallest, static_cast<double>(map.clearance_m(map.frame().cell_of(p))));
    }
  }
  return smallest;
}

RC_GTEST_PROP(DistanceTransform, AgreesWithBruteForce, (std::uint32_t seed)) {
  Rng rng(seed);
  Grid<std::uint8_t> cells(GridFrame{}, 1 + static_cast<int>(rng.below(24)), 1 + static_cast<int>(rng.below(24)));
  for (std::uint8_t& cell : cells.cells()) {
    cell = rng.uniform() < 0.08 ? 1 : 0;
  }
  const Grid<float> distance = distance_transform(cells);
  for (std::size_t a = 0; a < cells.cells().size(); ++a) {
    double nearest = kFarCells;
    for (std::size_t b = 0; b < cells.cells().size(); ++b) {
      if (cells.cells()[b] != 0) {
        const CellIndex p = cells.cell(a);
        const CellIndex q = cells.cell(b);
        nearest = std::min(nearest, std::hypot(p.i - q.i, p.j - q.j));
      }
    }
    RC_ASSERT(std::abs(static_cast<double>(distance.cells()[a]) - nearest) <= 1e-3 * nearest);
  }
}

TEST(CostMap, KeepsTheRobotsRadiusFromWallsAndOutOfTheUnknown) {
  const CostMap map = map_of(ascii_map({"##########", "#........ ", "#........ ", "#........ ", "##########"}, 0.4));
  EXPECT_FALSE(map.traversable(Point2(0.5, 1.0)));
  EXPECT_TRUE(map.traversable(Point2(0.8, 1.0)));
  EXPECT_FALSE(map.traversable(Point2(3.8, 1.0)));
  EXPECT_TRUE(map.traversable(Point2(3.5, 1.0)));
  EXPECT_FALSE(map.traversable(Point2(-5.0, 1.0)));
  CostMapParams optimistic;
  optimistic.unknown_traversable = true;
  EXPECT_TRUE(map_of(ascii_map({"   ", " . ", "   "}, 0.4), {}, optimistic).traversable(Point2(0.1, 0.1)));
}

TEST(Planner, NamesTheCauseOfNoPath) {
  CostMapLimits limits;
  limits.bound = Polygon{{0.0, 0.0}, {7.0, 0.0}, {7.0, 3.0}, {0.0, 3.0}};
  limits.keep_out = {Polygon{{5.0, 0.0}, {6.0, 0.0}, {6.0, 1.0}, {5.0, 1.0}}};
  const CostMap map = map_of(two_rooms(), limits);
  const Point2 start(1.0, 1.5);
  EXPECT_EQ(cause_of_no_path(map, start, {2.0, 0.05}), UnreachableCause::kObstacle) << "in the wall";
  EXPECT_EQ(cause_of_no_path(map, start, {7.6, 1.5}), UnreachableCause::kOutsideBound);
  EXPECT_EQ(cause_of_no_path(map, start, {5.5, 0.5}), UnreachableCause::kKeptOut);
  EXPECT_EQ(cause_of_no_path(map, {7.6, 0.5}, start), UnreachableCause::kRobotForbidden);
  const CostMap free = map_of(two_rooms());
  EXPECT_EQ(cause_of_no_path(free, start, {20.0, 1.5}), UnreachableCause::kUnknownFloor) << "where the map ends";
  const CostMap rooms = map_of(ascii_map({"#########", "#...#...#", "#...#...#", "#...#...#", "#########"}, 0.4));
  EXPECT_EQ(cause_of_no_path(rooms, {1.0, 1.0}, {2.6, 1.0}), UnreachableCause::kCutOff);
  const CostMap closet = map_of(ascii_map({"####", "#. .", "####"}, 0.2));
  EXPECT_EQ(cause_of_no_path(closet, {0.3, 0.3}, {0.7, 0.3}), UnreachableCause::kRobotEnclosed);
  const Result<Path> refused = plan(map, start, {2.0, 0.05});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("it lies in an obstacle"), std::string::npos) << refused.error().message;
}

TEST(CostMap, CostsMoreNearWalls) {
  const CostMap map = map_of(two_rooms());
  EXPECT_GT(map.cost(map.frame().cell_of({1.0, 0.42})), map.cost(map.frame().cell_of({1.0, 0.6})));
  EXPECT_FLOAT_EQ(map.cost(map.frame().cell_of({1.5, 1.5})), 1.0F);
}

TEST(CostMap, AppliesBoundKeepOutObstaclesAndForbiddenPlaces) {
  CostMapLimits limits;
  limits.bound = Polygon{{0.0, 0.0}, {6.0, 0.0}, {6.0, 3.0}, {0.0, 3.0}};
  limits.keep_out = {{{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}, {1.0, 2.0}}};
  limits.obstacles = {{5.0, 1.5}, {1e12, -1e12}};
  limits.forbidden_discs = {{3.0, 1.5}};
  const CostMap map = map_of(two_rooms(), limits);
  EXPECT_FALSE(map.traversable(Point2(7.0, 1.5)));  // outside the bound
  EXPECT_FALSE(map.traversable(Point2(1.5, 1.5)));  // in the keep-out area
  EXPECT_FALSE(map.traversable(Point2(2.2, 1.5)));  // the footprint would reach into it
  EXPECT_FALSE(map.traversable(Point2(5.2, 1.5)));  // beside the extra obstacle
  EXPECT_FALSE(map.traversable(Point2(3.1, 1.5)));
  EXPECT_TRUE(map.traversable(Point2(3.0, 2.2)));
}

TEST(CostMap, RefusesCrossedPolygonsAndAnEmptyMap) {
  CostMapLimits limits;
  limits.keep_out = {{{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}};
  EXPECT_EQ(CostMap::build(two_rooms(), {}, limits).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(CostMap::build({}, {}).error().code, Errc::kInvalidArgument);
}

TEST(Plan, GoesThroughTheDoorWithClearance) {
  const CostMap map = map_of(two_rooms());
  const auto path = plan(map, {1.0, 0.6}, {7.0, 0.6});
  ASSERT_TRUE(path) << path.error().message;
  EXPECT_THAT(path->waypoints.front(), testing::Point2Near(Point2(1.0, 0.6), 1e-9));
  EXPECT_THAT(path->waypoints.back(), testing::Point2Near(Point2(7.0, 0.6), 1e-9));
  EXPECT_GT(smallest_clearance(map, *path), 0.29);
  EXPECT_GT(path->length_m, 6.0);
  EXPECT_LT(path->length_m, 7.6);
  EXPECT_LT(path->waypoints.size(), 20U);
  EXPECT_GE(path->cost, path->length_m);
}

TEST(Plan, AStraightWayIsTwoPoints) {
  const auto path = plan(map_of(two_rooms()), {0.8, 0.8}, {3.2, 2.1});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->waypoints.size(), 2U);
}

TEST(Plan, LeavesInflatedSpaceOnItsOwnSideOfTheWall) {
  const CostMap map = map_of(two_rooms());
  const auto path = plan(map, {3.9, 0.6}, {1.0, 1.0});  // 0.1 m from the wall at x = 4
  ASSERT_TRUE(path) << path.error().message;
  EXPECT_LT(path->length_m, 3.5);
  for (const Point2& p : path->waypoints) {
    EXPECT_LT(p.x(), 4.0);
  }
}

TEST(Plan, SaysWhatMakesAGoalUnreachable) {
  CostMapLimits limits;
  limits.keep_out = {{{3.5, 0.0}, {4.5, 0.0}, {4.5, 3.0}, {3.5, 3.0}}};
  const CostMap cut = map_of(two_rooms(), limits);
  EXPECT_EQ(plan(cut, {1.0, 1.0}, {7.0, 1.0}).error().code, Errc::kUnreachable);
  EXPECT_NE(plan(cut, {1.0, 1.0}, {7.0, 1.0}).error().message.find("no way"), std::string::npos);
  EXPECT_NE(plan(cut, {1.0, 1.0}, {20.0, 1.0}).error().message.find("goal"), std::string::npos);
  EXPECT_NE(plan(cut, {-9.0, 1.0}, {1.0, 1.0}).error().message.find("robot"), std::string::npos);
  EXPECT_EQ(plan(cut, {1.0, 1.0}, {NAN, 1.0}).error().code, Errc::kInvalidArgument);
}

TEST(DistanceField, AgreesWithAStarToEveryGoal) {
  const CostMap map = map_of(two_rooms());
  const auto field = DistanceField::build(map, {1.0, 0.6});
  ASSERT_TRUE(field);
  Rng rng(7);
  for (int k = 0; k < 40; ++k) {
    const Point2 goal(rng.uniform(0.4, 7.6), rng.uniform(0.4, 2.6));
    if (!map.traversable(goal)) {
      continue;
    }
    const auto direct = plan(map, {1.0, 0.6}, goal);
    const auto from_field = field->path_to(map, goal);
    ASSERT_TRUE(direct && from_field);
    EXPECT_NEAR(field->cost_to(goal).value(), direct->cost, 0.11) << "seed 7, goal " << goal.transpose();
    EXPECT_NEAR(from_field->length_m, direct->length_m, 0.25);
  }
  EXPECT_FALSE(field->cost_to(Point2(4.05, 0.5)));
  EXPECT_FALSE(field->cost_to(Point2(100.0, 0.5)));
  EXPECT_TRUE(field->cheapest_near({4.05, 0.5}, 0.6));
}

TEST(ReachableFloor, IsTheErodedFloorConnectedToTheStart) {
  const CostMap map = map_of(two_rooms());
  const auto floor = reachable_floor(map, {1.0, 1.0}, 0.2);
  ASSERT_TRUE(floor);
  const double area = 0.04 * static_cast<double>(std::count(floor->cells().begin(), floor->cells().end(), 1));
  EXPECT_NEAR(area, 2 * 3.3 * 2.2 + 0.9 * 0.35, 1.2);
  EXPECT_EQ(((*floor)[floor->frame().cell_of({7.0, 1.5})]), 1);
  EXPECT_EQ(((*floor)[floor->frame().cell_of({0.15, 1.5})]), 0);

  CostMapLimits limits;
  limits.keep_out = {{{3.5, 0.0}, {4.5, 0.0}, {4.5, 3.0}, {3.5, 3.0}}};
  const auto half = reachable_floor(map_of(two_rooms(), limits), {1.0, 1.0}, 0.2);
  ASSERT_TRUE(half);
  EXPECT_EQ(((*half)[half->frame().cell_of({7.0, 1.5})]), 0);
  EXPECT_EQ(((*half)[half->frame().cell_of({1.0, 1.5})]), 1);
}

TEST(ReachableFloor, NeedsAStartOnTheFloorAndACoarserGrid) {
  const CostMap map = map_of(two_rooms());
  EXPECT_EQ(reachable_floor(map, {-5.0, 0.0}, 0.2).error().code, Errc::kUnreachable);
  EXPECT_EQ(reachable_floor(map, {1.0, 1.0}, 0.01).error().code, Errc::kInvalidArgument);
}

}  // namespace
}  // namespace seeker::nav
