#include "server/explore/blocked_ways.hpp"

#include <gtest/gtest.h>

#include "server/explore/wait_turns.hpp"
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
BlockedWays blocked_in(const std::vector<std::string>& before, const std::vector<std::string>& now,
                       const std::vector<Point2>& obstacles_map = {}) {
  KnownFloor known;
  known.add(view_of(before), {4.0, 1.0}, 3.0);
  nav::FloorView floor = view_of(now);
  nav::CostMapLimits limits;
  limits.obstacles = obstacles_map;
  floor.cost = *nav::CostMap::build(floor.occupancy, {}, limits);
  const auto costs = nav::DistanceField::build(floor.cost, kRobot.translation());
  const std::vector<MapSegment> none;
  const nav::ForbiddenAreas areas;
  return blocked_ways({floor, *costs, none, areas, kRobot, {}}, known, obstacles_map, {});
}

TEST(BlockedWays, SomebodyInACorridorIsInTheWayOfWhatLiesBehind) {
  const auto blocked = blocked_in(corridor(14), with_somebody(corridor(14)));
  ASSERT_EQ(blocked.at_map.size(), 1U);
  EXPECT_THAT(blocked.at_map.front(), Point2Near(Point2(4.1, 0.6), 0.4));
  ASSERT_FALSE(blocked.behind_map.empty());
  for (const Point2& p_map : blocked.behind_map) {
    EXPECT_GT(p_map.x(), 4.5);
  }
}

TEST(BlockedWays, SomebodyWhomOneCanPassIsInNobodysWay) {
  const auto blocked = blocked_in(corridor(30), with_somebody(corridor(30)));
  EXPECT_TRUE(blocked.at_map.empty());
  EXPECT_TRUE(blocked.behind_map.empty());
}

TEST(BlockedWays, WhereNothingIsLeftNobodyIsInTheWay) {
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

TEST(BlockedWays, WhatIsRememberedOfSomebodyIsInTheWayToo) {
  // He has gone on, but the robot still plans around where it met him.
  const auto blocked = blocked_in(corridor(14), corridor(14), {{4.0, 0.5}, {4.0, 0.7}, {4.0, 0.9}});
  EXPECT_FALSE(blocked.at_map.empty());
  EXPECT_FALSE(blocked.behind_map.empty());
}

TEST(WaitTurns, EveryPlaceHasItsTurnBeforeAnyHasTheNext) {
  ViewpointParams params;
  params.max_waits = 2;
  WaitTurns turns(params);
  const std::vector<BlockedPlace> places{{{0.0, 0.0}, true}, {{5.0, 0.0}, true}, {{0.0, 5.0}, true}};
  for (int round = 0; round < 2; ++round) {
    for (const BlockedPlace& place : places) {
      const auto turn = turns.next(places);
      ASSERT_TRUE(turn.has_value());
      EXPECT_EQ(turn->p_map, place.p_map);
    }
  }
  EXPECT_FALSE(turns.next(places).has_value());
  turns.reset();
  EXPECT_TRUE(turns.next(places).has_value());
}

TEST(WaitTurns, EverySecondTimeTheRobotStepsAside) {
  WaitTurns turns({});
  for (const bool aside : {false, true, false, true}) {
    EXPECT_EQ(turns.next({{{1.0, 0.0}, true}}), (WaitTurn{{1.0, 0.0}, aside}));
  }
  EXPECT_EQ(turns.next({{{9.0, 0.0}, false}}), (WaitTurn{{9.0, 0.0}, false})) << "nobody wants to walk by";
}

TEST(WaitTurns, WhereNobodyWasSeenOneWaitEachIsEnough) {
  const ViewpointParams params;
  WaitTurns turns(params);
  std::vector<BlockedPlace> places;
  for (int k = 0; k < 8; ++k) {
    places.push_back({{3.0 * k, 0.0}, false});
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_TRUE(turns.next(places).has_value());
  }
  EXPECT_FALSE(turns.next(places).has_value());
  WaitTurns at_one(params);
  for (int k = 0; k < params.max_failures; ++k) {
    EXPECT_TRUE(at_one.next({places.front()}).has_value());
  }
  EXPECT_FALSE(at_one.next({places.front()}).has_value());
}

TEST(WaitTurns, PeopleWhoAreSomewhereElseEachTimeAreNotWaitedForForEver) {
  WaitTurns turns({});
  int waits = 0;
  for (; turns.next({{{3.0 * waits, 0.0}, true}}).has_value(); ++waits) {
    ASSERT_LT(waits, 100);
  }
  EXPECT_GT(waits, ViewpointParams{}.max_waits);
}

}  // namespace
}  // namespace seeker::explore
