#include "server/search/cut_off.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "server/nav/planner.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/nav/ascii_map.hpp"

namespace seeker::search {
namespace {

using seeker::testing::Point2Near;

constexpr double kCell_m = 0.1;
const Point2 kRobot{1.0, 2.0};
const Point2 kDoor{5.05, 2.0};

/// Two rooms of 5 x 4 m behind each other, joined by a door of 1.2 m.
std::vector<std::string> rooms() {
  std::vector<std::string> rows(40, "#" + std::string(99, '.') + "#");
  rows.front() = rows.back() = std::string(101, '#');
  for (std::size_t row = 0; row < rows.size(); ++row) {
    rows[row][50] = row >= 14 && row < 26 ? '.' : '#';
  }
  return rows;
}

nav::FloorView view_of(const std::vector<std::string>& rows, const std::vector<Point2>& obstacles = {}) {
  const auto occupancy = nav::ascii_map(rows, kCell_m);
  nav::CostMapLimits limits;
  limits.obstacles = obstacles;
  auto cost = nav::CostMap::build(occupancy, {}, limits);
  auto floor = nav::reachable_floor(*cost, kRobot, 0.2);
  return {occupancy, std::move(*cost), std::move(*floor), 1, {}};
}

nav::KnownFloor known_of(const nav::FloorView& view) {
  nav::KnownFloor known;
  known.add(view, kRobot, 3.0);
  return known;
}

std::ptrdiff_t cells_beyond_the_door(const Grid<std::uint8_t>& floor) {
  std::ptrdiff_t count = 0;
  for (std::size_t k = 0; k < floor.cells().size(); ++k) {
    count += floor.cells()[k] != 0 && floor.frame().centre_of(floor.cell(k)).x() > 5.5 ? 1 : 0;
  }
  return count;
}

TEST(CutOff, ARoomBehindSomebodyInTheDoorIsStillToBeSearched) {
  std::vector<std::string> now = rooms();
  for (std::size_t row = 16; row < 24; ++row) {
    now[row].replace(49, 4, "####");
  }
  const nav::FloorView view = view_of(now);
  const nav::KnownFloor known = known_of(view_of(rooms()));
  EXPECT_EQ(cells_beyond_the_door(view.reachable), 0);
  EXPECT_GT(cells_beyond_the_door(floor_to_search(view, known)), 300);
  const auto places = blocked_places(view, known, EvidenceGrid(), {});
  ASSERT_EQ(places.size(), 1U);
  EXPECT_TRUE(places.front().somebody);
  EXPECT_THAT(places.front().p_map, Point2Near(kDoor, 0.4));
}

TEST(CutOff, APointThatClosesTheDoorCutsOffAllThatLiesBehind) {
  // Of the door 0.66 m are left for the robot's middle: two points close it by no more than the robot's width.
  const nav::FloorView view = view_of(rooms(), {{5.05, 1.75}, {5.05, 2.25}});
  const nav::KnownFloor known = known_of(view_of(rooms()));
  EXPECT_EQ(cells_beyond_the_door(view.reachable), 0);
  EXPECT_GT(cells_beyond_the_door(floor_to_search(view, known)), 300);
  EXPECT_EQ(blocked_places(view, known, EvidenceGrid(), {}).size(), 1U);
}

TEST(CutOff, FloorThatNoWayEverLedToIsNotAnsweredFor) {
  std::vector<std::string> shut = rooms();
  for (std::size_t row = 14; row < 26; ++row) {
    shut[row][50] = '#';
  }
  const nav::FloorView view = view_of(shut);
  EXPECT_EQ(floor_to_search(view, known_of(view)), view.reachable);
  EXPECT_TRUE(blocked_places(view, known_of(view), EvidenceGrid(), {}).empty());
}

TEST(CutOff, TheSeamOfReachableFloorIsNotCutOff) {
  // A corner turns out to be a bit nearer than it seemed: of one cell the middle can be entered, but less than half.
  std::vector<Point2> corner;
  for (double way_m = 0.225; way_m < 2.0; way_m += 0.05) {
    corner.emplace_back(0.225, way_m);
    corner.emplace_back(way_m, 0.225);
  }
  const nav::FloorView view = view_of(rooms(), corner);
  const nav::KnownFloor known = known_of(view_of(rooms()));
  const Point2 seam(0.5, 0.5);
  ASSERT_EQ(view.reachable[view.reachable.frame().cell_of(seam)], 0);
  ASSERT_TRUE(view.cost.traversable(seam) && known.was_reachable(seam));
  EXPECT_EQ(floor_to_search(view, known), view.reachable);
}

TEST(CutOff, NobodyIsWaitedForWhereAllThatLiesBehindIsSearched) {
  std::vector<std::string> now = rooms();
  for (std::size_t row = 16; row < 24; ++row) {
    now[row].replace(49, 4, "####");
  }
  EvidenceGrid evidence;
  for (const double x : {6.0, 7.5, 9.0}) {
    for (const double y : {0.8, 1.6, 2.4, 3.2}) {
      evidence.add_look(nav::ascii_map(rooms(), kCell_m), {x, y}, 0.4);
    }
  }
  EXPECT_TRUE(blocked_places(view_of(now), known_of(view_of(rooms())), evidence, {}).empty());
}

}  // namespace
}  // namespace seeker::search
