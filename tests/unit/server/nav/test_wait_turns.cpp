#include "server/nav/wait_turns.hpp"

#include <gtest/gtest.h>

namespace seeker::nav {
namespace {

TEST(WaitTurns, EveryPlaceHasItsTurnBeforeAnyHasTheNext) {
  WaitParams params;
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
  const WaitParams params;
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
  for (int k = 0; k < params.max_for_nobody; ++k) {
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
  EXPECT_GT(waits, WaitParams{}.max_waits);
}

}  // namespace
}  // namespace seeker::nav
