#include "server/drivers/interfaces/pacer.hpp"

#include <algorithm>
#include <chrono>

#include <gtest/gtest.h>

namespace seeker::drivers {
namespace {

using std::chrono::milliseconds;

constexpr Duration kPeriod = milliseconds(100);

/// A loop on a wall clock that the test sets.
class Loop {
 public:
  explicit Loop(double speed) : pacer(speed) {}

  /// Comes for its next tick after `work`, and begins it when it is due. Returns how long it slept.
  Duration tick(Duration work) {
    now += work;
    const Duration slept = std::max(Duration::zero(), Duration(pacer.due(kPeriod, now) - now));
    now += slept;
    pacer.begun(now);
    return slept;
  }

  Pacer pacer;
  Pacer::WallTime now{milliseconds(5000)};
};

TEST(Pacer, SleepsWhatTheWorkHasLeftOfThePeriod) {
  Loop loop(1.0);
  EXPECT_EQ(loop.tick({}), Duration::zero()) << "nothing came before the first tick";
  EXPECT_EQ(loop.tick(milliseconds(30)), milliseconds(70));
  EXPECT_EQ(loop.tick(milliseconds(99)), milliseconds(1));
  EXPECT_EQ(loop.pacer.timing(), (TickTiming{.ticks = 3, .late = 0, .worst = {}}));
}

TEST(Pacer, GoesAtTheSpeedAskedFor) {
  Loop loop(4.0);
  loop.tick({});
  EXPECT_EQ(loop.tick({}), milliseconds(25));
}

TEST(Pacer, CatchesUpWhenItIsALittleLate) {
  Loop loop(1.0);
  loop.tick({});
  EXPECT_EQ(loop.tick(milliseconds(180)), Duration::zero());
  EXPECT_EQ(loop.tick(milliseconds(5)), milliseconds(15));
}

TEST(Pacer, GoesOnFromNowWhenItIsTooLateToCatchUp) {
  Loop loop(1.0);
  loop.tick({});
  loop.tick(milliseconds(2000));
  EXPECT_EQ(loop.tick(milliseconds(40)), milliseconds(60));
}

TEST(Pacer, CountsTicksThatBeginMoreThanTwentyMillisecondsAfterTheirTime) {
  Loop loop(1.0);
  loop.tick({});
  loop.tick(milliseconds(120));
  EXPECT_EQ(loop.pacer.timing(), (TickTiming{.ticks = 2, .late = 0, .worst = milliseconds(20)}));
  loop.tick(milliseconds(101));
  EXPECT_EQ(loop.pacer.timing(), (TickTiming{.ticks = 3, .late = 1, .worst = milliseconds(21)}));
  loop.tick(milliseconds(2079));
  EXPECT_EQ(loop.pacer.timing(), (TickTiming{.ticks = 4, .late = 2, .worst = milliseconds(2000)}));
}

TEST(Pacer, RestIsNotLateness) {
  Loop loop(1.0);
  loop.tick({});
  loop.pacer.rest();
  EXPECT_EQ(loop.tick(milliseconds(60'000)), Duration::zero());
  EXPECT_EQ(loop.tick(milliseconds(10)), milliseconds(90));
  EXPECT_EQ(loop.pacer.timing(), (TickTiming{.ticks = 3, .late = 0, .worst = {}}));
}

TEST(Pacer, AsFastAsPossibleItNeitherWaitsNorCounts) {
  Pacer pacer(0.0);
  for (int i = 0; i < 100; ++i) {
    pacer.start(std::chrono::hours(1));
    EXPECT_TRUE(pacer.await({}));
  }
  EXPECT_FALSE(pacer.timing());
}

TEST(Pacer, ItsCallerWaitsInSlicesOfItsOwn) {
  Pacer pacer(1.0);
  EXPECT_TRUE(pacer.await({})) << "no tick was started";
  pacer.start(std::chrono::hours(1));
  EXPECT_TRUE(pacer.await({})) << "the first tick is due at once";
  pacer.start(std::chrono::hours(1));
  EXPECT_FALSE(pacer.await(milliseconds(1)));
  EXPECT_FALSE(pacer.await({}));
  EXPECT_EQ(pacer.timing()->ticks, 1U);
  pacer.rest();
  EXPECT_TRUE(pacer.await({})) << "who rests waits for nothing";
}

}  // namespace
}  // namespace seeker::drivers
