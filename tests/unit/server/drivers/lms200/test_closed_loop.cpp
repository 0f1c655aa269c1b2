#include <gtest/gtest.h>

#include "tests/unit/server/drivers/lms200/lms_line.hpp"

namespace seeker::drivers {
namespace {

namespace lms = lms200;

constexpr double kMillimetre_m = 0.001;

/// Largest error of the stamps from scan `first` on. The clock of the world has steps of a millimetre.
double worst_stamp_error_s(const std::vector<LaserScan>& scans, std::size_t first) {
  double worst_s = 0.0;
  for (std::size_t i = first; i < scans.size(); ++i) {
    worst_s = std::max(worst_s, std::abs(stamp_error_s(scans[i])));
  }
  return worst_s;
}

void expect_world(const LmsLine& line, std::size_t beams, double unit_m = kMillimetre_m) {
  RobotTime last = RobotTime::min();
  for (const LaserScan& scan : line.scans) {
    ASSERT_TRUE(validate(scan).has_value());
    EXPECT_EQ(scan.ranges_m.size(), beams);
    EXPECT_TRUE(shows_world(scan, unit_m));
    EXPECT_GT(scan.stamp, last);
    last = scan.stamp;
  }
}

TEST(LmsClosedLoop, FromPowerOnToScansInAFewSeconds) {
  LmsLine line;
  line.open();
  ASSERT_TRUE(line.run_until_scan(8.0));
  EXPECT_TRUE(line.session.state().has_value());
  line.scans.clear();
  line.run(60.0);
  EXPECT_NEAR(static_cast<double>(line.scans.size()), 60.0 * 75.0 / 16.0, 2.0);
  expect_world(line, 361);
  EXPECT_LT(worst_stamp_error_s(line.scans, 0), 0.001);
  EXPECT_FALSE(line.session.warning());
  EXPECT_EQ(line.session.statistics().connects, 1U);
  EXPECT_EQ(line.reopened, 0);
}

TEST(LmsClosedLoop, EachVariantHasItsAnglesRangesAndStamps) {
  for (const lms::Variant& variant : {lms::Variant{180, 100}, lms::Variant{180, 50}, lms::Variant{100, 100},
                                      lms::Variant{100, 50}, lms::Variant{100, 25}}) {
    LmsParams params;
    params.variant = variant;
    LmsLine line(params);
    line.open();
    line.run(20.0);
    ASSERT_GT(line.scans.size(), 30U) << to_string(variant);
    expect_world(line, variant.beams());
    EXPECT_LT(worst_stamp_error_s(line.scans, 0), 0.0015) << to_string(variant);
  }
}

TEST(LmsClosedLoop, ASubRangeHasItsAnglesAndStamps) {
  LmsParams params;
  params.sub_range = lms::SubRange{101, 221};
  LmsLine line(params);
  line.open();
  line.run(20.0);
  ASSERT_GT(line.scans.size(), 100U);
  expect_world(line, 121);
  // The beam ahead is 20 beams off the middle of the sub-range: 10 degrees of the mirror, 0.4 ms.
  EXPECT_LT(worst_stamp_error_s(line.scans, 0), 0.002);
}

TEST(LmsClosedLoop, EachRateIsReachedFromEachRateAlsoFromOneAtWhichTheDeviceStillSends) {
  for (const std::uint32_t wanted : {9600U, 19200U, 38400U}) {
    for (const std::uint32_t left_at : {9600U, 19200U, 38400U}) {
      LmsParams params;
      params.baud = wanted;
      params.search_bauds = {9600, 19200, 38400};
      LmsLine line(params);
      line.inject(lms::SetMode{*lms::baud_mode(left_at), {}});
      line.run(0.1);
      line.inject(lms::SetMode{lms::operating_mode::kContinuous, {}});
      line.run(1.0);
      ASSERT_EQ(line.device.baud(), left_at);
      line.open();
      ASSERT_TRUE(line.run_until_scan(25.0)) << left_at << " to " << wanted;
      EXPECT_EQ(line.device.baud(), wanted);
      line.run(5.0);
      expect_world(line, 361);
      EXPECT_EQ(line.reopened, 0);
    }
  }
}

TEST(LmsClosedLoop, At500000BaudEveryScanComes) {
  LmsParams params;
  params.baud = 500000;
  params.search_bauds = {9600, 19200, 38400};
  LmsLine line(params);
  line.open();
  ASSERT_TRUE(line.run_until_scan(15.0));
  line.scans.clear();
  line.run(20.0);
  EXPECT_NEAR(static_cast<double>(line.scans.size()), 20.0 * 37.5, 3.0);
  EXPECT_LT(worst_stamp_error_s(line.scans, 0), 0.001);
}

TEST(LmsClosedLoop, LateHostsMoveNoStampByMoreThanAFewMilliseconds) {
  LmsLine line;
  line.faults.jitter_s = 0.016;
  line.faults.stall_s = 0.150;
  line.open();
  line.run(1200.0);
  ASSERT_GT(line.scans.size(), 5000U);
  expect_world(line, 361);
  EXPECT_LT(worst_stamp_error_s(line.scans, 0), 0.020);
  EXPECT_LT(worst_stamp_error_s(line.scans, 20), 0.003);
}

TEST(LmsClosedLoop, BitErrorsCostTheirTelegramsOnlyAndNoWrongRangeIsDelivered) {
  LmsLine line;
  line.faults.bit_errors = 1e-4;
  line.faults.jitter_s = 0.004;
  line.open();
  line.run(600.0);
  // A telegram of 5856 bits comes without an error with a probability of 0.557.
  EXPECT_GT(line.scans.size(), 1200U);
  expect_world(line, 361);
  EXPECT_GT(line.session.statistics().packets_bad, 500U);
  EXPECT_LT(worst_stamp_error_s(line.scans, 20), 0.006);
}

TEST(LmsClosedLoop, SilenceIsALostLinkWithCauseAndRemedyAndEndsWithTheSilence) {
  LmsLine line;
  line.open();
  ASSERT_TRUE(line.run_until_scan(8.0));
  line.faults.silent = true;
  line.run(2.3, false);
  EXPECT_TRUE(line.session.wants_reopen());
  const Status lost = line.session.state();
  ASSERT_FALSE(lost.has_value());
  EXPECT_EQ(lost.error().code, Errc::kLinkLost);
  EXPECT_NE(lost.error().message.find("check its power and its cable"), std::string::npos);
  line.run(10.0);
  line.faults.silent = false;
  ASSERT_TRUE(line.run_until_scan(20.0));
  line.run(10.0);
  expect_world(line, 361);
  EXPECT_LT(worst_stamp_error_s(line.scans, 0), 0.001);
}

TEST(LmsClosedLoop, APowerCycleIsRecoveredFromAtAnyMoment) {
  Rng rng(17);
  LmsLine line;
  line.open();
  for (int i = 0; i < 25; ++i) {
    line.run(rng.uniform(0.0, 12.0));
    line.power_cycle();
  }
  ASSERT_TRUE(line.run_until_scan(30.0));
  line.run(10.0);
  expect_world(line, 361);
  EXPECT_LT(worst_stamp_error_s(line.scans, 0), 0.001);
  EXPECT_TRUE(line.session.state().has_value());
}

TEST(LmsClosedLoop, ARateThatSomebodyElseChangedIsFoundAgain) {
  LmsLine line;
  line.open();
  ASSERT_TRUE(line.run_until_scan(8.0));
  line.inject(lms::SetMode{*lms::baud_mode(19200), {}});
  line.run(4.0, false);
  ASSERT_FALSE(line.session.state().has_value());
  EXPECT_NE(line.session.state().error().message.find("damaged"), std::string::npos);
  ASSERT_TRUE(line.run_until_scan(20.0));
  EXPECT_EQ(line.device.baud(), 38400U);
}

TEST(LmsClosedLoop, WithoutADeviceTheRatesAndTheRemedyAreNamed) {
  LmsLine line;
  line.faults.silent = true;
  line.open();
  line.run(60.0, false);
  EXPECT_TRUE(line.session.wants_reopen());
  const Status state = line.session.state();
  ASSERT_FALSE(state.has_value());
  EXPECT_EQ(state.error().code, Errc::kTimeout);
  EXPECT_NE(state.error().message.find("38400, 9600, 19200"), std::string::npos);
}

TEST(LmsClosedLoop, TheFlashIsNotWrittenUnaskedAndTheDevicesOwnUnitIsUsed) {
  LmsLine line({}, {});  // a device in cm
  line.open();
  ASSERT_TRUE(line.run_until_scan(8.0));
  EXPECT_TRUE(line.session.state().has_value());
  expect_world(line, 361, 0.01);
  ASSERT_TRUE(line.session.warning());
  EXPECT_NE(line.session.warning()->message.find("may_write_flash"), std::string::npos);
  EXPECT_EQ(line.device.flash(), lms::ConfigBlock());
}

TEST(LmsClosedLoop, TheFlashIsWrittenOnceWhereThatIsAllowed) {
  LmsParams params;
  params.may_write_flash = true;
  params.measuring_mode = lms::MeasuringMode::k32mReflector;
  LmsLine line(params, {});
  line.open();
  ASSERT_TRUE(line.run_until_scan(10.0));
  line.run(3.0);
  expect_world(line, 361);
  EXPECT_FALSE(line.session.warning());
  EXPECT_NEAR(line.scans.back().range_max_m, 32.759, 1e-9);
  const auto writes = [&] { return std::count(line.written.begin(), line.written.end(), 0x77); };
  EXPECT_EQ(writes(), 1);
  line.power_cycle();
  ASSERT_TRUE(line.run_until_scan(30.0));
  EXPECT_EQ(writes(), 1);
}

TEST(LmsClosedLoop, ADirtyWindowIsAWarningWhileScansGoOn) {
  LmsLine line;
  line.open();
  ASSERT_TRUE(line.run_until_scan(8.0));
  line.device.set_faults({true, false, 0.0});
  line.run(2.0);
  ASSERT_TRUE(line.session.warning());
  EXPECT_NE(line.session.warning()->message.find("clean"), std::string::npos);
  EXPECT_TRUE(line.session.state().has_value());
  line.device.set_faults({});
  line.run(2.0);
  EXPECT_FALSE(line.session.warning());
}

TEST(LmsClosedLoop, ScansOfADeviceWithAFatalErrorAreNotUsed) {
  LmsLine line;
  line.open();
  ASSERT_TRUE(line.run_until_scan(8.0));
  line.device.set_faults({false, true, 0.0});
  line.run(0.5);
  line.scans.clear();
  line.run(3.0, false);
  EXPECT_TRUE(line.scans.empty());
  ASSERT_FALSE(line.session.state().has_value());
  EXPECT_NE(line.session.state().error().message.find("fatal"), std::string::npos);
  line.run(20.0);
  ASSERT_FALSE(line.session.state().has_value());
  line.device.set_faults({});
  EXPECT_TRUE(line.run_until_scan(20.0));
}

TEST(LmsClosedLoop, WrongChecksumsAreCountedAndLeftOut) {
  LmsLine line;
  line.open();
  ASSERT_TRUE(line.run_until_scan(8.0));
  line.device.set_faults({false, false, 0.3});
  line.scans.clear();
  line.run(100.0);
  EXPECT_NEAR(static_cast<double>(line.scans.size()), 0.7 * 469.0, 50.0);
  EXPECT_NEAR(static_cast<double>(line.session.statistics().packets_bad), 0.3 * 469.0, 50.0);
  expect_world(line, 361);
}

TEST(LmsClosedLoop, TheFarewellStopsTheDeviceAndGivesBackItsRate) {
  LmsLine line;
  line.open();
  ASSERT_TRUE(line.run_until_scan(8.0));
  line.close();
  line.run(2.0);
  EXPECT_EQ(line.device.baud(), 9600U);
  EXPECT_FALSE(line.session.state().has_value());
  const std::uint64_t before = line.session.statistics().bytes_in;
  line.run(5.0);
  EXPECT_EQ(line.session.statistics().bytes_in, before);
  line.open();
  EXPECT_TRUE(line.run_until_scan(10.0));
}

}  // namespace
}  // namespace seeker::drivers
