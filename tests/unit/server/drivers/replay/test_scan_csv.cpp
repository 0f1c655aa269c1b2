#include "server/drivers/replay/scan_csv.hpp"

#include <string>

#include <gtest/gtest.h>

#include "common/core/scan.hpp"
#include "server/drivers/replay/replay.hpp"
#include "tests/support/data.hpp"
#include "tests/support/matchers.hpp"

namespace seeker::drivers {
namespace {

TEST(ScanCsv, ALineIsATimeAPoseAndRanges) {
  const auto scan = parse_scan_csv_line("1663967375.7, 6.5,-8.25,1.5,0.5,,inf,nan,2.25\r");
  ASSERT_TRUE(scan) << scan.error().message;
  EXPECT_EQ(scan->stamp_s, 1663967375.7);
  EXPECT_THAT(*scan->odom_T_base, testing::Pose2Near(Pose2{6.5, -8.25, 1.5}, 1e-12, 1e-12));
  EXPECT_EQ(scan->ranges_m, (std::vector<float>{0.5F, 0.0F, 0.0F, 0.0F, 2.25F}));
  EXPECT_FALSE(scan->corrected_T_laser);
}

TEST(ScanCsv, ARangeMayCarryItsSignalQuality) {
  const auto scan = parse_scan_csv_line("1.5,0,0,0,0.5:47,2.25:3,:0");
  ASSERT_TRUE(scan) << scan.error().message;
  EXPECT_EQ(scan->ranges_m, (std::vector<float>{0.5F, 2.25F, 0.0F}));
  EXPECT_EQ(scan->strengths, (std::vector<float>{47.0F, 3.0F, 0.0F}));
  for (const char* line : {"1.5,0,0,0,0.5:47,2.25", "1.5,0,0,0,0.5:x", "1.5,0,0,0,0.5:-1"}) {
    EXPECT_EQ(parse_scan_csv_line(line).error().code, Errc::kParse) << line;
  }
}

TEST(ScanCsv, MalformedLinesAreRefused) {
  for (const char* line :
       {"1,2,3", "1,2,3,4", "1,2,nan,4,5", "x,2,3,4,5", "1,2,3,4,5,six", "1,,3,4,5", "1,2,3,inf,5"}) {
    EXPECT_EQ(parse_scan_csv_line(line).error().code, Errc::kParse) << line;
  }
  std::string line = "1,2,3,4";
  for (std::size_t k = 0; k < kMaxScanBeams + 1; ++k) {
    line += ",1";
  }
  EXPECT_EQ(parse_scan_csv_line(line).error().code, Errc::kTooLarge);
}

TEST(LogLine, IsToldApartByItsContent) {
  EXPECT_TRUE(is_scan_csv(" 1.5,2,3,4,5"));
  EXPECT_FALSE(is_scan_csv("FLASER 1 1 0 0 0 0 0 0 1 a,b 1"));
  EXPECT_FALSE(is_scan_csv("t,x,y,theta,r0"));
  EXPECT_FALSE(is_scan_csv(""));
  const auto csv = parse_log_line("1.5,2,3,4,5");
  ASSERT_TRUE(csv && *csv);
  EXPECT_EQ(std::get<CarmenScan>(**csv).stamp_s, 1.5);
  const auto carmen = parse_log_line("FLASER 1 1 0 0 0 0 0 0 1 exact 1");
  ASSERT_TRUE(carmen && *carmen);
  EXPECT_EQ(std::get<CarmenScan>(**carmen).host, "exact");
}

TEST(RecordedScanCsv, IsReadWhole) {
  SEEKER_REQUIRE_DATA(path, "lidar/rplidar_a1/scans.csv.gz");
  const auto source = ReplaySource::open(path);
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_NEAR((*source)->first_stamp_s(), 1663967375.0, 60.0);
  int scans = 0;
  while ((*source)->advance_one()) {
    const auto scan = (*source)->take_scan();
    ASSERT_TRUE(scan);
    EXPECT_TRUE((*source)->take_odometry());
    EXPECT_EQ(scan->ranges_m.size(), 720U);
    ++scans;
  }
  EXPECT_EQ(scans, 357);
  EXPECT_EQ((*source)->summary().bad, 0U);
  EXPECT_EQ((*source)->summary().overtaken, 0U);
}

}  // namespace
}  // namespace seeker::drivers
