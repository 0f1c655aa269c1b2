#include "server/explore/blocked_paths.hpp"

#include <gtest/gtest.h>

#include "tests/support/matchers.hpp"
#include "tests/unit/server/nav/ascii_map.hpp"

namespace seeker::explore {
namespace {

using seeker::testing::Point2Near;

constexpr double kCell_m = 0.1;
const Pose2 kRobot{1.0, 1.0, 0.0};

/// A corridor of 8 x `rows` / 10 m; beyond x = 6 m nobody has looked.
std::vector<std::string> corridor(std::size_t rows) {
  std::vector<std::string> picture(rows, "#" + std::string(59, '.') + std::string(20, ' '));
  picture.front() = picture.back() = std::string(60, '#') + std::string(20, ' ');
  return picture;
}

/// Somebody 0.4 m wide stands at x = 4 m, 0.5 m to 0.9 m above the lower wall.
std::vector<std::string> with_somebody(std::vector<std::string> picture) {
  for (std::size_t row = picture.size() - 10; row < picture.size() - 6; ++row) {
    picture[row].replace(40, 4, "####");
  }
  return picture;
}

nav::FloorView view_of(const std::vector<std::string>& rows) {
  const auto occupancy = nav::ascii_map(rows, kCell_m);
  auto cost = nav::CostMap::build(occupancy);
  auto floor = nav::reachable_floor(*cost, kRobot.translation(), 0.2);
  return {occupancy, std::move(*cost), std::move(*floor), 1, {}};
}

/// The robot saw the floor `before`, and sees `now`.
BlockedPaths blocked_in(const std::vector<std::string>& before, const std::vector<std::string>& now,
                        const std::vector<Point2>& obstacles_map = {}) {
  nav::KnownFloor known;
  known.add(view_of(before), {4.0, 1.0}, 3.0);
  nav::FloorView floor = view_of(now);
  nav::CostMapLimits limits;
  limits.obstacles = obstacles_map;
  floor.cost = *nav::CostMap::build(floor.occupancy, {}, limits);
  const auto costs = nav::DistanceField::build(floor.cost, kRobot.translation());
  const std::vector<MapSegment> none;
  const nav::ForbiddenAreas areas;
  return blocked_paths({floor, *costs, none, areas, kRobot, {}}, known, obstacles_map, {});
}

TEST(BlockedPaths, SomebodyInACorridorIsInTheWayOfWhatLiesBehind) {
  const auto blocked = blocked_in(corridor(14), with_somebody(corridor(14)));
  ASSERT_EQ(blocked.at_map.size(), 1U);
  EXPECT_THAT(blocked.at_map.front(), Point2Near(Point2(4.1, 0.6), 0.4));
  ASSERT_FALSE(blocked.behind_map.empty());
  for (const UnreachablePlace& place : blocked.behind_map) {
    EXPECT_GT(place.p_map.x(), 4.5);
    EXPECT_GT(place.size_m, 0.0);
  }
}

TEST(BlockedPaths, SomebodyWhomOneCanPassIsInNobodysWay) {
  const auto blocked = blocked_in(corridor(30), with_somebody(corridor(30)));
  EXPECT_TRUE(blocked.at_map.empty());
  EXPECT_TRUE(blocked.behind_map.empty());
}

TEST(BlockedPaths, WhereNothingIsLeftNobodyIsInTheWay) {
  std::vector<std::string> all = corridor(14);
  for (std::string& row : all) {
    row[59] = '#';
  }
  std::vector<std::string> now = all;
  now[6].replace(58, 1, "#");
  const auto blocked = blocked_in(all, now);
  EXPECT_TRUE(blocked.at_map.empty());
  EXPECT_TRUE(blocked.behind_map.empty());
}

TEST(BlockedPaths, WhatIsRememberedOfSomebodyIsInTheWayToo) {
  // He has gone on, but the robot still plans around where it met him.
  const auto blocked = blocked_in(corridor(14), corridor(14), {{4.0, 0.5}, {4.0, 0.7}, {4.0, 0.9}});
  EXPECT_FALSE(blocked.at_map.empty());
  EXPECT_FALSE(blocked.behind_map.empty());
}

}  // namespace
}  // namespace seeker::explore
