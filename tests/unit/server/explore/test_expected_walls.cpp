// What of a wall is expected beyond what was seen of it, and what that says about the floor behind a hidden corner.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "server/explore/expected_walls.hpp"
#include "server/explore/view_gain.hpp"
#include "tests/unit/server/explore/scenes.hpp"
#include "tests/unit/server/nav/ascii_map.hpp"

namespace seeker::explore {
namespace {

constexpr double kFine_m = 0.1;
constexpr double kLongest_m = 0.6;

/// 4 x 3 m of free floor at the lower left of 6 x 5 m that nobody has seen.
nav::CostMap floor_with_unknown_around() {
  std::vector<std::string> rows(50, std::string(60, ' '));
  for (std::size_t row = 20; row < 50; ++row) {
    rows[row] = std::string(40, '.') + std::string(20, ' ');
  }
  auto map = nav::CostMap::build(nav::ascii_map(rows, kFine_m));
  EXPECT_TRUE(map.has_value());
  return *std::move(map);
}

bool is_wall(const Grid<std::uint8_t>& walls, const Point2& p_map) { return walls[walls.frame().cell_of(p_map)] != 0; }

TEST(ExpectedWalls, GoOnStraightThroughUnknownFloor) {
  const nav::CostMap map = floor_with_unknown_around();
  const auto walls = expected_walls(map, {test::wall({1.0, 3.05}, {3.0, 3.05})}, kLongest_m);
  EXPECT_TRUE(is_wall(walls, {2.0, 3.05})) << "what is mapped";
  EXPECT_TRUE(is_wall(walls, {3.5, 3.05}));
  EXPECT_TRUE(is_wall(walls, {0.5, 3.05}));
  EXPECT_FALSE(is_wall(walls, {3.8, 3.05})) << "no farther than that";
  EXPECT_FALSE(is_wall(walls, {2.0, 4.0}));
}

TEST(ExpectedWalls, EndAtCornersAndAtFreeFloor) {
  const nav::CostMap map = floor_with_unknown_around();
  const auto at_corner = expected_walls(map, {test::wall({1.0, 3.05}, {3.0, 3.05}, {false, true})}, kLongest_m);
  EXPECT_FALSE(is_wall(at_corner, {3.3, 3.05}));
  EXPECT_TRUE(is_wall(at_corner, {0.7, 3.05}));
  const auto into_floor = expected_walls(map, {test::wall({4.5, 1.55}, {4.2, 1.55})}, kLongest_m);
  EXPECT_TRUE(is_wall(into_floor, {4.1, 1.55}));
  EXPECT_FALSE(is_wall(into_floor, {3.7, 1.55}));
}

TEST(ExpectedWalls, AreAlsoThoseOfOtherRobots) {
  const nav::CostMap map = floor_with_unknown_around();
  const std::vector<MappedSide> theirs{
      {{1.0, 3.05}, {3.0, 3.05}}, {{4.5, 1.55}, {4.2, 1.55}}, {{2.0, 4.0}, {2.0, 4.0}}};
  const auto walls = expected_walls(map, {}, kLongest_m, theirs);
  EXPECT_TRUE(is_wall(walls, {2.0, 3.05}));
  EXPECT_TRUE(is_wall(walls, {3.5, 3.05}));
  EXPECT_FALSE(is_wall(walls, {3.7, 1.55})) << "free floor";
  EXPECT_FALSE(is_wall(walls, {2.0, 4.0})) << "a side without length";
}

TEST(ExpectedWalls, OutsideOfTheMapAreNone) {
  const nav::CostMap map = floor_with_unknown_around();
  const auto walls = expected_walls(map, {test::wall({-3.0, -1.0}, {9.0, -1.0})}, kLongest_m);
  EXPECT_EQ(std::count(walls.cells().begin(), walls.cells().end(), 0), static_cast<long>(walls.cells().size()));
}

TEST(ExpectedWalls, CloseAHiddenCorner) {
  // Both walls end half a metre before the corner at (4.05, 3.05).
  const nav::CostMap map = floor_with_unknown_around();
  const std::vector<MapSegment> both{test::wall({0.0, 3.05}, {3.5, 3.05}), test::wall({4.05, 2.5}, {4.05, 0.0})};
  SensorModel sensor;
  sensor.range_m = 1.5;  // nothing but the corner is in sight
  const Point2 before_the_corner(3.6, 2.6);
  const auto walls = expected_walls(map, both, kLongest_m);
  EXPECT_GT(view_gain(map, before_the_corner, sensor).area_m2, 1.0);
  EXPECT_LT(view_gain(map, before_the_corner, sensor, &walls).area_m2, 0.3);
}

}  // namespace
}  // namespace seeker::explore
