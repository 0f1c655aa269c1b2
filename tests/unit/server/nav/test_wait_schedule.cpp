#include "server/nav/wait_schedule.hpp"

#include <gtest/gtest.h>

namespace seeker::nav {
namespace {

TEST(WaitSchedule, EveryPlaceIsWaitedAtBeforeAnyIsWaitedAtAgain) {
  WaitParams params;
  params.max_waits = 2;
  WaitSchedule schedule(params);
  const std::vector<BlockedPlace> places{{{0.0, 0.0}, true}, {{5.0, 0.0}, true}, {{0.0, 5.0}, true}};
  for (int round = 0; round < 2; ++round) {
    for (const BlockedPlace& place : places) {
      const auto wait = schedule.next(places);
      ASSERT_TRUE(wait.has_value());
      EXPECT_EQ(wait->p_map, place.p_map);
    }
  }
  EXPECT_FALSE(schedule.next(places).has_value());
  schedule.reset();
  EXPECT_TRUE(schedule.next(places).has_value());
}

TEST(WaitSchedule, EverySecondTimeTheRobotStepsAside) {
  WaitSchedule schedule({});
  for (const bool aside : {false, true, false, true}) {
    EXPECT_EQ(schedule.next({{{1.0, 0.0}, true}}), (PlannedWait{{1.0, 0.0}, aside}));
  }
  EXPECT_EQ(schedule.next({{{9.0, 0.0}, false}}), (PlannedWait{{9.0, 0.0}, false})) << "nobody wants to walk by";
}

TEST(WaitSchedule, WhereNobodyWasSeenOneWaitEachIsEnough) {
  const WaitParams params;
  WaitSchedule schedule(params);
  std::vector<BlockedPlace> places;
  for (int k = 0; k < 8; ++k) {
    places.push_back({{3.0 * k, 0.0}, false});
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_TRUE(schedule.next(places).has_value());
  }
  EXPECT_FALSE(schedule.next(places).has_value());
  WaitSchedule at_one(params);
  for (int k = 0; k < params.max_for_nobody; ++k) {
    EXPECT_TRUE(at_one.next({places.front()}).has_value());
  }
  EXPECT_FALSE(at_one.next({places.front()}).has_value());
}

TEST(WaitSchedule, PeopleWhoAreSomewhereElseEachTimeAreNotWaitedForForEver) {
  WaitSchedule schedule({});
  int waits = 0;
  for (; schedule.next({{{3.0 * waits, 0.0}, true}}).has_value(); ++waits) {
    ASSERT_LT(waits, 100);
  }
  EXPECT_GT(waits, WaitParams{}.max_waits);
}

}  // namespace
}  // namespace seeker::nav
