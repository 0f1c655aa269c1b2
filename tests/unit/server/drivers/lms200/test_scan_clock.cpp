#include <cmath>

#include <gtest/gtest.h>

#include "common/core/rng.hpp"
#include "server/drivers/lms200/byte_arrivals.hpp"
#include "server/drivers/lms200/scan_clock.hpp"

namespace seeker::drivers {
namespace {

/// A scanner whose line is slower than its mirror, and a host that is late.
struct Stream {
  double true_period_s = 2.0 / 75.0;
  int scans_apart = 8;
  double jitter_s = 0.0;  ///< uniform
  double stall_s = 0.0;   ///< of one arrival in fifty
  double lost = 0.0;      ///< part of the telegrams
  Rng rng{5};
  std::int64_t scan = 0;

  struct Arrival {
    double sent_s;
    double arrival_s;
  };
  Arrival next() {
    do {
      scan += scans_apart;
    } while (rng.uniform() < lost);
    const double sent_s = 3.0 + static_cast<double>(scan) * true_period_s;
    const double stalled_s = rng.below(50) == 0 ? stall_s : 0.0;
    return {sent_s, sent_s + rng.uniform(0.0, jitter_s) + stalled_s};
  }
};

ScanClock clock_of_half_degrees() {
  ScanClockParams params;
  params.period_s = 2.0 / 75.0;
  return ScanClock(params);
}

/// Largest error over `count` arrivals after the first `skip`.
double worst_error_s(Stream& stream, ScanClock& clock, int skip, int count) {
  double worst_s = 0.0;
  for (int i = 0; i < skip + count; ++i) {
    const Stream::Arrival arrival = stream.next();
    const double placed_s = to_seconds(clock.place(robot_time_s(arrival.arrival_s)));
    EXPECT_LE(placed_s, arrival.arrival_s + 1e-9);
    worst_s = i < skip ? 0.0 : std::max(worst_s, std::abs(placed_s - arrival.sent_s));
  }
  return worst_s;
}

TEST(LmsScanClock, WithoutDelaysArrivalsAreReturned) {
  Stream stream;
  ScanClock clock = clock_of_half_degrees();
  EXPECT_LT(worst_error_s(stream, clock, 0, 1000), 1e-6);
}

TEST(LmsScanClock, JitterOf16MillisecondsLeavesAFewMilliseconds) {
  Stream stream;
  stream.jitter_s = 0.016;
  ScanClock clock = clock_of_half_degrees();
  EXPECT_LT(worst_error_s(stream, clock, 20, 100), 0.006);
  EXPECT_LT(worst_error_s(stream, clock, 0, 20000), 0.004);
}

TEST(LmsScanClock, TheErrorDoesNotDriftOverHoursAlthoughTheMirrorIsNotQuiteAsFastAsStated) {
  for (const double relative : {-0.005, -0.0005, 0.0005, 0.005}) {
    Stream stream;
    stream.true_period_s *= 1.0 + relative;
    stream.jitter_s = 0.010;
    ScanClock clock = clock_of_half_degrees();
    EXPECT_LT(worst_error_s(stream, clock, 130, 3 * 3600 * 5), 0.003) << relative;
  }
}

TEST(LmsScanClock, ATelegramThatComesLateAndLostOnesMoveNoStamp) {
  Stream stream;
  stream.jitter_s = 0.004;
  stream.stall_s = 0.150;
  stream.lost = 0.05;
  ScanClock clock = clock_of_half_degrees();
  EXPECT_LT(worst_error_s(stream, clock, 20, 20000), 0.004);
}

TEST(LmsScanClock, TheDistanceIsFoundAlthoughNearlyHalfOfTheTelegramsAreLost) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Stream stream;
    stream.rng = Rng(seed);
    stream.jitter_s = 0.004;
    stream.lost = 0.45;
    ScanClock clock = clock_of_half_degrees();
    EXPECT_LT(worst_error_s(stream, clock, 0, 200), 0.005) << seed;
  }
}

TEST(LmsScanClock, AFastLineOnWhichEveryScanIsSentIsFollowedToo) {
  Stream stream;
  stream.scans_apart = 1;
  stream.jitter_s = 0.012;
  ScanClock clock = clock_of_half_degrees();
  EXPECT_LT(worst_error_s(stream, clock, 20, 20000), 0.005);
}

TEST(LmsScanClock, AChangeOfPhaseIsFollowedWithinTwoSeconds) {
  Stream stream;
  stream.jitter_s = 0.002;
  ScanClock clock = clock_of_half_degrees();
  EXPECT_LT(worst_error_s(stream, clock, 20, 200), 0.002);
  stream.scan += 3;  // the device left scans out
  (void)worst_error_s(stream, clock, 0, 9);
  EXPECT_LT(worst_error_s(stream, clock, 10, 200), 0.002);
}

TEST(LmsScanClock, UntilTheDistanceIsKnownArrivalsAreReturned) {
  Stream stream;
  stream.jitter_s = 0.016;
  ScanClock clock = clock_of_half_degrees();
  for (int i = 0; i < 7; ++i) {
    const RobotTime arrival = robot_time_s(stream.next().arrival_s);
    EXPECT_EQ(clock.place(arrival), arrival);
    EXPECT_FALSE(clock.distance_known());
  }
  (void)clock.place(robot_time_s(stream.next().arrival_s));
  EXPECT_TRUE(clock.distance_known());
}

TEST(LmsByteArrivals, ABytesLatestArrivalIsThatOfItsPieceLessTheBytesBehindIt) {
  ByteArrivals arrivals(seconds(0.001));
  arrivals.note(0, 10, robot_time_s(1.0));
  EXPECT_EQ(arrivals.latest_arrival(9), robot_time_s(1.0));
  EXPECT_EQ(arrivals.latest_arrival(4), robot_time_s(0.995));
}

TEST(LmsByteArrivals, ALaterPieceThatWasNotDelayedShowsWhenTheFirstCame) {
  ByteArrivals arrivals(seconds(0.001));
  arrivals.note(0, 4, robot_time_s(1.050));  // 47 ms late
  arrivals.note(4, 60, robot_time_s(1.063));
  EXPECT_EQ(arrivals.latest_arrival(0), robot_time_s(1.000));
}

TEST(LmsByteArrivals, ALineWithoutRateShowsThePiecesTime) {
  ByteArrivals arrivals(Duration(0));
  arrivals.note(0, 400, robot_time_s(1.0));
  arrivals.note(400, 332, robot_time_s(1.2));
  EXPECT_EQ(arrivals.latest_arrival(3), robot_time_s(1.0));
}

TEST(LmsByteArrivals, MemoryIsBounded) {
  ByteArrivals arrivals(seconds(0.001));
  for (std::uint64_t i = 0; i < 100000; ++i) {
    arrivals.note(i, 1, robot_time_s(0.001 * static_cast<double>(i)));
  }
  EXPECT_EQ(arrivals.latest_arrival(99000), robot_time_s(99.0));
}

}  // namespace
}  // namespace seeker::drivers
