#include "server/nav/lookout.hpp"

#include <gtest/gtest.h>

#include "ascii_map.hpp"
#include "server/nav/visibility.hpp"

namespace seeker::nav {
namespace {

/// 7 x 5 m in cells of 0.25 m: two rooms with a wall of one cell between them, joined at their left ends.
std::vector<std::string> two_rooms() {
  std::vector<std::string> rows(20, '#' + std::string(26, '.') + '#');
  rows.front() = rows.back() = std::string(28, '#');
  rows[10] = "#......" + std::string(21, '#');
  return rows;
}

struct Rooms {
  FloorView floor;
  DistanceField costs;
};

Rooms rooms_of(const std::vector<std::string>& rows, const Point2& robot_map) {
  const auto occupancy = ascii_map(rows, 0.25);
  auto cost = CostMap::build(occupancy, {}, {});
  auto reachable = reachable_floor(*cost, robot_map, 0.2);
  auto costs = DistanceField::build(*cost, robot_map);
  return {{occupancy, *cost, *reachable, 1, {}}, *costs};
}

TEST(Lookout, IsOnTheSideOfAWallThatSeesThePlace) {
  const Point2 robot_map(6.0, 1.2);
  const Point2 place_map(6.0, 3.2);  // half a metre beyond the wall, 10 m by the way around
  const Rooms rooms = rooms_of(two_rooms(), robot_map);
  const auto lookout = lookout_for(place_map, rooms.floor, rooms.costs);
  ASSERT_TRUE(lookout);
  EXPECT_TRUE(line_of_sight(rooms.floor.occupancy, *lookout, place_map));
  EXPECT_GT(lookout->y(), 2.5);
  // The nearest by the way alone is where the robot is, on the other side.
  const auto nearest = rooms.costs.cheapest_near(place_map, 1.5);
  ASSERT_TRUE(nearest);
  EXPECT_FALSE(line_of_sight(rooms.floor.occupancy, rooms.floor.cost.frame().centre_of(*nearest), place_map));
}

TEST(Lookout, SeesPastWhoeverStandsThere) {
  std::vector<std::string> rows(20, '#' + std::string(26, '.') + '#');
  rows.front() = rows.back() = std::string(28, '#');
  rows[9].replace(19, 2, "##");
  rows[10].replace(19, 2, "##");
  const Rooms rooms = rooms_of(rows, {1.0, 2.5});
  const auto lookout = lookout_for({5.0, 2.5}, rooms.floor, rooms.costs);
  ASSERT_TRUE(lookout);
  EXPECT_LT((*lookout - Point2(5.0, 2.5)).norm(), 1.6);
}

TEST(Lookout, IsTheNearestPlaceWhereNoneSeesIt) {
  std::vector<std::string> rows = two_rooms();
  rows[10] = std::string(28, '#');  // the other room is shut
  const Rooms rooms = rooms_of(rows, {6.0, 1.2});
  const Point2 place_map(6.0, 3.2);
  const auto lookout = lookout_for(place_map, rooms.floor, rooms.costs);
  ASSERT_TRUE(lookout);
  EXPECT_LT((*lookout - place_map).norm(), 1.5);
  EXPECT_FALSE(lookout_for({6.0, 4.6}, rooms.floor, rooms.costs)) << "nowhere near";
}

TEST(PlaceAside, LiesInTheRoomBesideTheCorridor) {
  // A corridor 1.25 m wide with a room of 4 x 3.5 m on its left half; somebody comes along the corridor.
  std::vector<std::string> rows(20, "#................#" + std::string(22, '#'));
  rows.front() = std::string(40, '#');
  rows.back() = std::string(40, '#');
  rows[13] = std::string(6, '#') + "...." + std::string(30, '#');
  for (std::size_t row = 14; row < 19; ++row) {
    rows[row] = '#' + std::string(38, '.') + '#';
  }
  const Rooms rooms = rooms_of(rows, {5.0, 0.9});
  const auto aside = place_aside({7.0, 0.9}, rooms.floor, rooms.costs);
  ASSERT_TRUE(aside);
  EXPECT_GT(aside->y(), 2.0) << "in the room";
  EXPECT_GT(rooms.floor.cost.clearance_m(rooms.floor.cost.frame().cell_of(*aside)), 1.3);
}

}  // namespace
}  // namespace seeker::nav
