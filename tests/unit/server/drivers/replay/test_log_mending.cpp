#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/rng.hpp"
#include "server/drivers/replay/carmen_reader.hpp"
#include "server/drivers/replay/invented_clock.hpp"
#include "server/drivers/replay/log_survey.hpp"
#include "server/drivers/replay/stamp_order.hpp"
#include "tests/support/carmen_scans.hpp"
#include "tests/unit/server/drivers/replay/temporary_log.hpp"

namespace seeker::drivers {
namespace {

constexpr double kPeriod_s = 0.2;

/// The mended stamps; -1 for a record that is refused.
std::vector<double> placed(const std::vector<double>& stamps_s) {
  StampOrder order(kPeriod_s);
  double offset_s = 0.0;
  std::vector<double> result_s;
  for (auto stamp = stamps_s.begin(); stamp != stamps_s.end(); ++stamp) {
    const auto rest = std::min<std::ptrdiff_t>(stamps_s.end() - stamp - 1, StampOrder::kLookAhead);
    const auto placed_s = order.place(*stamp, std::vector<double>(stamp + 1, stamp + 1 + rest), offset_s);
    result_s.push_back(placed_s ? *placed_s : -1.0);
  }
  return result_s;
}

std::size_t refused(const std::vector<double>& stamps_s) {
  return static_cast<std::size_t>(std::count(stamps_s.begin(), stamps_s.end(), -1.0));
}

/// Stamps at kPeriod_s from `from_s` on.
std::vector<double> steady(double from_s, int count) {
  std::vector<double> stamps_s;
  for (int k = 0; k < count; ++k) {
    stamps_s.push_back(from_s + kPeriod_s * k);
  }
  return stamps_s;
}

std::vector<double> operator+(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(StampOrder, StampsThatRiseStayAsTheyAre) {
  const std::vector<double> stamps_s = steady(976052890.0, 50) + steady(976053890.0, 50);
  EXPECT_EQ(placed(stamps_s), stamps_s);
}

TEST(StampOrder, OneWrongStampCostsOneRecord) {
  for (const double wrong_s : {0.0, 95.0, 5000.0, 1e9}) {
    for (const int at : {0, 30}) {
      const std::vector<double> stamps_s = steady(100.0, at) + std::vector<double>{wrong_s} + steady(106.2, 50);
      const std::vector<double> result_s = placed(stamps_s);
      if (at == 0 && wrong_s == 95.0) {
        EXPECT_EQ(refused(result_s), 0U) << "a pause after the first record is no fault";
        continue;
      }
      const bool wrong = at > 0 || wrong_s > 106.2;  // from 0 s to 106 s may be a pause
      EXPECT_EQ(refused(result_s), wrong ? 1U : 0U) << wrong_s << " at " << at;
      EXPECT_EQ(result_s.back(), stamps_s.back());
    }
  }
}

TEST(StampOrder, AClockThatWasNeverSetBeforeTheFirstRecordIsNotBelieved) {
  const std::vector<double> result_s = placed(std::vector<double>{0.0} + steady(976052890.0, 20));
  EXPECT_EQ(refused(result_s), 1U);
  EXPECT_EQ(result_s[1], 976052890.0);
}

TEST(StampOrder, AClockThatIsSetWhileItRecordsCostsNoRecord) {
  for (const double to_s : {10.0, 1e9}) {  // back, and ahead by more than any pause
    const std::vector<double> result_s = placed(steady(1000.0, 50) + steady(to_s, 50));
    EXPECT_EQ(refused(result_s), 0U) << to_s;
    for (std::size_t k = 1; k < result_s.size(); ++k) {
      EXPECT_NEAR(result_s[k] - result_s[k - 1], kPeriod_s, 1e-6) << to_s << ' ' << k;
    }
  }
}

TEST(StampOrder, WhateverALogSaysTheStampsRise) {
  Rng rng(1);
  for (int run = 0; run < 200; ++run) {
    std::vector<double> stamps_s;
    for (int k = 0; k < 100; ++k) {
      const double magnitude_s = std::pow(10.0, rng.uniform(-3.0, 308.0 * rng.uniform()));
      stamps_s.push_back((rng.uniform() < 0.3 ? -1.0 : 1.0) * (rng.uniform() < 0.5 ? 0.1 * k : magnitude_s));
    }
    double last_s = -std::numeric_limits<double>::infinity();
    for (const double stamp_s : placed(stamps_s)) {
      if (stamp_s != -1.0) {
        EXPECT_TRUE(std::isfinite(stamp_s));
        EXPECT_GT(stamp_s, last_s) << "run " << run;
        last_s = stamp_s;
      }
    }
  }
}

TEST(StampOrder, RecordsOfAClockThatCountsSecondsAreSetApart) {
  std::vector<double> stamps_s;
  for (int k = 0; k < 53; ++k) {
    stamps_s.push_back(100.0 + k / 5);
  }
  const std::vector<double> result_s = placed(stamps_s);
  EXPECT_EQ(refused(result_s), 0U);
  for (std::size_t k = 1; k < result_s.size(); ++k) {
    EXPECT_GT(result_s[k], result_s[k - 1]);
    EXPECT_NEAR(result_s[k], 100.0 + 0.2 * static_cast<double>(k), 0.3);
  }
}

/// The scans that the reader gives of a log.
std::vector<CarmenScan> scans_of(const std::string& text) {
  const TemporaryLog log("mending", text);
  return testing::carmen_scans(log.path()).value();
}

/// A front laser at x with these readings.
std::string front_laser(double x_m, double stamp_s, const std::string& ranges) {
  const std::string pose = std::to_string(x_m) + " 0 0 ";
  return "FLASER 3 " + ranges + " " + pose + pose + std::to_string(stamp_s) + " host " + std::to_string(stamp_s) + "\n";
}

TEST(LogSurvey, TheFarthestReadingFromManyPlacesIsWhatTheLaserSaysOfNothing) {
  std::string moving;
  std::string standing;
  for (int k = 0; k < 20; ++k) {
    moving += front_laser(0.2 * k, k, "1.0 " + std::to_string(7.0 - 0.2 * k) + " 8.19");
    standing += front_laser(0.0, k, "1.0 7.0 8.19");
  }
  const std::vector<CarmenScan> scans = scans_of(moving);
  ASSERT_EQ(scans.size(), 20U);
  ASSERT_TRUE(scans.front().range_max_m) << "from the first scan on";
  EXPECT_NEAR(*scans.front().range_max_m, 8.19, 1e-5);
  EXPECT_FALSE(scans_of(standing).front().range_max_m) << "a wall is as far as it is from one place";
  std::string fading;
  for (int k = 0; k < 400; ++k) {
    fading += front_laser(0.2 * k, k, "1.0 2.0 " + std::to_string(k % 80 == 0 ? 5.6 : 4.0 + 0.01 * (k % 70)));
  }
  EXPECT_FALSE(scans_of(fading).front().range_max_m) << "a weak laser fades out near its reach";
}

TEST(LogSurvey, AScanThatWasWrittenTwiceIsReadOnceWithItsOdometry) {
  std::string text;
  for (int k = 0; k < 10; ++k) {
    const std::string stamp = std::to_string(k) + ".0";
    const std::string laser = "0 -1.57 3.14 1.57 80 0.01 0 3 1 1 1 0 ";
    text += "RAWLASER1 " + laser + stamp + " host " + stamp + "\n";
    text += "ROBOTLASER1 " + laser + "1 2 3 4 5 0.6 0 0 1 1 0 " + stamp + " host " + stamp + "\n";
  }
  const std::vector<CarmenScan> scans = scans_of(text);
  ASSERT_EQ(scans.size(), 10U);
  for (const CarmenScan& scan : scans) {
    EXPECT_TRUE(scan.odom_T_base);
  }
}

TEST(LogSurvey, OdometryOfScansThatStandsStillWhileTheRobotMovesIsNone) {
  std::string text;
  for (int k = 0; k < 10; ++k) {
    text += "ODOM " + std::to_string(0.1 * k) + " 0 0 0.1 0 0 " + std::to_string(k) + ".0 host 1\n";
    text += front_laser(0.0, k + 0.5, "1 1 1");
  }
  const std::vector<CarmenScan> scans = scans_of(text);
  ASSERT_EQ(scans.size(), 10U);
  EXPECT_FALSE(scans.front().odom_T_base);
}

/// A robot that drives 0.1 m between scans and sometimes 0.4 m, with odometry between; all stamps cut to six digits.
std::string log_without_times(int scans) {
  std::string text;
  double x_m = 0.0;
  for (int k = 0; k < scans; ++k) {
    x_m += k % 50 == 49 ? 0.4 : 0.1;
    const std::string x = std::to_string(x_m);
    text += "ODOM " + x + " 0 0 0.1 0 0 1.01893e+09 host 1\n";
    text += "FLASER 3 1 1 1 " + x + " 0 0 " + x + " 0 0 1.01893e+09 host 1.01893e+09\n";
  }
  return text;
}

TEST(InventedClock, StampsThatWereCutGiveWayToTimesThatTheMotionAllows) {
  const std::vector<CarmenScan> scans = scans_of(log_without_times(200));
  ASSERT_EQ(scans.size(), 200U);
  for (std::size_t k = 1; k < scans.size(); ++k) {
    const double step_s = scans[k].stamp_s - scans[k - 1].stamp_s;
    const double way_m = scans[k].odom_T_base->x_m - scans[k - 1].odom_T_base->x_m;
    EXPECT_GE(step_s, 0.05) << "scan " << k;
    EXPECT_LE(way_m / step_s, 1.01) << "scan " << k << ": faster than wheels go without effort";
  }
  EXPECT_LT(scans.back().stamp_s - scans.front().stamp_s, 200.0) << "and not a second for each scan";
}

TEST(InventedClock, OdometryAndScansKeepTheOrderOfTheLog) {
  const TemporaryLog log("order", log_without_times(60));
  auto reader = CarmenReader::open(log.path());
  ASSERT_TRUE(reader) << reader.error().message;
  double last_s = -1.0;
  std::uint64_t records = 0;
  while (const auto record = reader->next()) {
    EXPECT_GT(stamp_of(*record), last_s) << "record " << records;
    last_s = stamp_of(*record);
    ++records;
  }
  EXPECT_EQ(records, 120U);
  EXPECT_THAT(describe(reader->summary()), ::testing::HasSubstr("too coarse to show"));
}

TEST(InventedClock, AJumpOfTheOdometryStaysOne) {
  InventedClock clock(0.1);
  EXPECT_EQ(clock.place(CarmenOdometry{0.0, {0.0, 0.0, 0.0}, {}}), 0.0);
  EXPECT_NEAR(clock.place(CarmenOdometry{0.0, {2.0, 0.0, 0.0}, {}}), 2.0, 1e-9);
  EXPECT_NEAR(clock.place(CarmenOdometry{0.0, {80.0, 0.0, 0.0}, {}}), 2.1, 1e-9);
}

TEST(InventedClock, AClockThatCountsSecondsIsBelieved) {
  std::string text;
  for (int k = 0; k < 60; ++k) {
    text += front_laser(0.1 * k, 1000.0 + k / 5, "1 1 1");
  }
  const TemporaryLog log("seconds", text);
  auto reader = CarmenReader::open(log.path());
  ASSERT_TRUE(reader) << reader.error().message;
  while (reader->next()) {
  }
  EXPECT_FALSE(reader->summary().invented_period_s);
  EXPECT_NEAR(reader->summary().duration_s, 12.0, 1.0);
}

}  // namespace
}  // namespace seeker::drivers
