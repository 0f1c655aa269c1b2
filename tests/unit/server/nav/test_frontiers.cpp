#include "server/nav/frontiers.hpp"

#include <gtest/gtest.h>

#include "tests/unit/server/nav/ascii_map.hpp"

namespace seeker::nav {
namespace {

constexpr double kCell_m = 0.1;
constexpr double kNoise_m = 0.4;

/// A room of 3 x 4 m whose right wall has an opening about the middle, behind which nobody has seen anything.
std::vector<std::string> room_with_opening(double width_m, const std::string& wall = "#") {
  std::vector<std::string> rows;
  const double middle_m = 2.0;
  for (int row = 0; row < 40; ++row) {
    const bool open = std::abs((row + 0.5) * kCell_m - middle_m) < width_m / 2.0;
    const std::string right = open ? "." : std::string(1, wall[static_cast<std::size_t>(row) % wall.size()]);
    rows.push_back(std::string(30, '.') + right + std::string(10, ' '));
  }
  rows.front() = rows.back() = std::string(41, '#');
  for (std::string& row : rows) {
    row.front() = '#';
  }
  return rows;
}

std::vector<Frontier> frontiers_of(const std::vector<std::string>& rows) {
  const auto map = CostMap::build(ascii_map(rows, kCell_m));
  EXPECT_TRUE(map.has_value());
  const auto costs = DistanceField::build(*map, {1.5, 1.0});
  EXPECT_TRUE(costs.has_value());
  return find_frontiers(*map, *costs, kNoise_m);
}

TEST(Frontiers, ABorderIsNearUntilWhatLiesBehindItIsSeen) {
  const auto rows = room_with_opening(1.0);
  const auto open = CostMap::build(ascii_map(rows, kCell_m));
  ASSERT_TRUE(open);
  const Point2 p = frontiers_of(rows).at(0).p_map;
  EXPECT_TRUE(border_near(*open, p, 0.5));
  EXPECT_FALSE(border_near(*open, {1.0, 1.0}, 0.5));
  const auto closed = CostMap::build(ascii_map(room_with_opening(0.0), kCell_m));
  ASSERT_TRUE(closed);
  EXPECT_FALSE(border_near(*closed, p, 0.5));
}

TEST(Frontiers, ADoorIsAsWideAsItsPostsAreApart) {
  for (const double width_m : {0.8, 1.0}) {
    const auto found = frontiers_of(room_with_opening(width_m));
    ASSERT_EQ(found.size(), 1U) << width_m << " m";
    EXPECT_NEAR(found.front().length_m, width_m, 0.11);
    EXPECT_NEAR(found.front().p_map.y(), 2.0, 0.25) << "the goal is where the robot's centre can be";
  }
}

TEST(Frontiers, AGapThatTheRobotDoesNotFitThroughIsNone) { EXPECT_TRUE(frontiers_of(room_with_opening(0.4)).empty()); }

TEST(Frontiers, AGapInAWallOfDotsIsNotAsLongAsTheWall) {
  // The wall was seen so flat that only every second bit of it is in the map; between them the unknown shows.
  const auto found = frontiers_of(room_with_opening(0.8, "#.."));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(found.front().length_m, 1.6);
}

TEST(Frontiers, AFewUnknownCellsInOpenFloorAreNoise) {
  std::vector<std::string> rows = room_with_opening(0.0);
  rows[20][15] = ' ';
  const auto map = CostMap::build(ascii_map(rows, kCell_m));
  const auto costs = DistanceField::build(*map, {1.5, 1.0});
  EXPECT_TRUE(find_frontiers(*map, *costs, 0.7).empty());
}

}  // namespace
}  // namespace seeker::nav
