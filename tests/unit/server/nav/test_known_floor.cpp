#include "server/nav/known_floor.hpp"

#include <gtest/gtest.h>

#include "ascii_map.hpp"
#include "server/nav/planner.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::nav {
namespace {

using seeker::testing::Point2Near;

constexpr double kCell_m = 0.25;
const Point2 kRobot{1.0, 2.0};

/// 10 x 4 m.
std::vector<std::string> hall() {
  std::vector<std::string> rows(16, "#......................................#");
  rows.front() = rows.back() = std::string(40, '#');
  return rows;
}

FloorView view_of(const std::vector<std::string>& rows) {
  const auto occupancy = ascii_map(rows, kCell_m);
  auto cost = CostMap::build(occupancy);
  auto floor = reachable_floor(*cost, kRobot, 0.2);
  return {occupancy, std::move(*cost), std::move(*floor), 1, {}};
}

/// The hall with something of one block in it, 0.25 x 0.25 m about (x, 2.1).
FloorView with_a_thing_at(double x_m) {
  std::vector<std::string> rows = hall();
  rows[7][static_cast<std::size_t>(x_m / kCell_m)] = '#';
  return view_of(rows);
}

TEST(KnownFloor, SomebodyOnFloorThatWasFreeIsNoticed) {
  KnownFloor known;
  known.add(view_of(hall()), kRobot, 3.0);
  const auto places = known.occupied_now(with_a_thing_at(3.0), {});
  ASSERT_EQ(places.size(), 1U);
  EXPECT_THAT(places.front().p_map, Point2Near(Point2(3.1, 2.1), 0.2));
}

TEST(KnownFloor, FloorSeenFromAfarIsNotTrusted) {
  KnownFloor known;
  known.add(view_of(hall()), kRobot, 3.0);
  EXPECT_TRUE(known.occupied_now(with_a_thing_at(6.0), {}).empty());
  EXPECT_TRUE(known.was_reachable({8.0, 2.1})) << "but a way led there";
  known.add(view_of(hall()), {6.0, 2.0}, 3.0);
  EXPECT_EQ(known.occupied_now(with_a_thing_at(6.0), {}).size(), 1U);
}

TEST(KnownFloor, AMappedWallIsNobody) {
  KnownFloor known;
  known.add(view_of(hall()), kRobot, 3.0);
  MapSegment wall;
  wall.id = 1;
  wall.map_T_segment = {3.1, 2.1, 0.0};
  wall.length_m = 2.0;
  EXPECT_TRUE(known.occupied_now(with_a_thing_at(3.0), {wall}).empty());
  wall.length_m = 0.3;  // as short as a person is wide
  EXPECT_EQ(known.occupied_now(with_a_thing_at(3.0), {wall}).size(), 1U);
}

TEST(KnownFloor, MovesWithTheMap) {
  KnownFloor known;
  known.add(view_of(hall()), kRobot, 3.0);
  const Pose2 new_T_old{3.0, -2.0, 0.4};
  known.transform(new_T_old);
  EXPECT_TRUE(known.was_reachable(new_T_old * Point2(8.0, 2.1)));
  EXPECT_TRUE(known.contains(new_T_old * kRobot));
  EXPECT_FALSE(known.was_reachable(new_T_old * Point2(8.0, 4.5))) << "beyond the wall";
  known.add(view_of(hall()), kRobot, 3.0);
  EXPECT_TRUE(known.was_reachable({8.0, 2.1})) << "cells of both line up";
}

}  // namespace
}  // namespace seeker::nav
