#include "server/drivers/replay/carmen_writer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "server/drivers/replay/line_sink.hpp"
#include "server/drivers/replay/replay.hpp"
#include "tests/unit/server/drivers/replay/temporary_log.hpp"

namespace seeker::drivers {
namespace {

/// Seconds since 1970 at a moment of 2026.
constexpr double kEpoch_s = 1795867240.25;

Pose2 pose_from(Rng& rng) { return {rng.uniform(-50.0, 50.0), rng.uniform(-50.0, 50.0), rng.uniform(-3.1, 3.1)}; }

/// A scan of any scanner: returns, beams without one, unusable beams, quality or none.
LaserScan scan_from(Rng& rng) {
  LaserScan scan;
  const std::size_t beams = 2 + rng.below(720);
  scan.stamp = robot_time_s(1e-6 * static_cast<double>(rng.below(1'000'000'000)));
  scan.angle_min_rad = rng.uniform(-3.1, 0.0);
  scan.angle_step_rad = rng.uniform(0.001, 6.2 / static_cast<double>(beams));
  scan.range_min_m = 0.02;
  scan.range_max_m = rng.uniform(4.0, 40.0);
  scan.base_T_laser = {rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3), rng.uniform(-3.0, 3.0)};
  scan.ranges_m.reserve(beams);
  scan.quality.reserve(beams);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const bool returned = rng.uniform() < 0.8;
    const bool usable = returned || rng.uniform() < 0.5;
    scan.ranges_m.push_back(returned ? static_cast<float>(rng.uniform(0.03, scan.range_max_m - 0.02)) : kNoReturn);
    scan.quality.push_back(usable ? static_cast<std::uint8_t>(2 + rng.below(254)) : std::uint8_t{0});
  }
  return scan;
}

RC_GTEST_PROP(CarmenWriter, WritesOdometryThatReadsBackEqual, (std::uint64_t seed)) {
  Rng rng(seed);
  const CarmenOdometry odometry{.odom_T_base = pose_from(rng),
                                .velocity = {rng.uniform(-1.0, 1.0), rng.uniform(-2.0, 2.0)}};
  const double stamp_s = kEpoch_s + rng.uniform(0.0, 1e4);
  const auto record = parse_carmen_line(carmen_odometry_line(odometry, {stamp_s, 1.0}));
  RC_ASSERT(record && *record);
  const auto& read = std::get<CarmenOdometry>(**record);
  RC_ASSERT(read.odom_T_base == odometry.odom_T_base);
  RC_ASSERT(read.velocity == odometry.velocity);
  RC_ASSERT(std::abs(read.stamp_s - stamp_s) < 1e-6);
}

RC_GTEST_PROP(CarmenWriter, WritesScansThatReadBackEqual, (std::uint64_t seed)) {
  Rng rng(seed);
  const LaserScan scan = scan_from(rng);
  const Pose2 odom_T_base = pose_from(rng);
  const double stamp_s = kEpoch_s + to_seconds(scan.stamp);
  const auto record = parse_carmen_line(carmen_scan_line(scan, odom_T_base, {}, {stamp_s, to_seconds(scan.stamp)}));
  RC_ASSERT(record && *record);
  const auto& read = std::get<CarmenScan>(**record);
  RC_ASSERT(read.odom_T_base == odom_T_base);
  RC_ASSERT(std::abs(read.stamp_s - stamp_s) < 1e-6);
  const LaserScan again = to_laser_scan(read, {.base_T_laser = scan.base_T_laser}, scan.stamp);
  RC_ASSERT(again.ranges_m == scan.ranges_m);
  RC_ASSERT(again.quality == scan.quality);
  RC_ASSERT(again.angle_min_rad == scan.angle_min_rad);
  RC_ASSERT(std::abs(again.angle_step_rad - scan.angle_step_rad) < 1e-12);
  RC_ASSERT(again.range_max_m == scan.range_max_m);
}

TEST(CarmenWriter, KeepsTheDirectionOfAScannerThatRotatesClockwise) {
  LaserScan scan;
  scan.angle_min_rad = 1.5;
  scan.angle_step_rad = -0.01;
  scan.range_max_m = 8.0;
  scan.ranges_m = {1.0F, 2.0F, 3.0F};
  const auto record = parse_carmen_line(carmen_scan_line(scan, {}, {}, {kEpoch_s, 0.0}));
  ASSERT_TRUE(record && *record);
  EXPECT_EQ(std::get<CarmenScan>(**record).angle_step_rad, -0.01);
}

TEST(CarmenWriter, WritesTheLongestScanWithinTheLongestLine) {
  LaserScan scan;
  scan.angle_step_rad = 1e-4;
  scan.range_max_m = 8.0;
  scan.ranges_m.assign(kMaxScanBeams, 1.23456789e-5F);
  scan.quality.assign(kMaxScanBeams, 255);
  EXPECT_LT(carmen_scan_line(scan, {}, {}, {kEpoch_s, 0.0}).size(), LineFile::kMaxLine_bytes);
}

TEST(CarmenWriter, StatesMountAndRobotInCommentsThatReadersSkip) {
  const std::string text = carmen_header("r1") + carmen_mount_comment({0.15, -0.05, deg_to_rad(90.0)});
  EXPECT_NE(text.find("r1"), std::string::npos);
  EXPECT_NE(text.find("0.15 -0.05 90"), std::string::npos);
  EXPECT_EQ(text.front(), '#');
  EXPECT_EQ(text.back(), '\n');
}

/// A name in the temporary folder without a file.
class LineSinkFile : public ::testing::TestWithParam<const char*> {
 public:
  ~LineSinkFile() override {
    std::filesystem::remove(path_);
    std::filesystem::remove(second());
  }

 protected:
  LineSinkFile() : path_(TemporaryLog(GetParam(), "").path()) {}
  [[nodiscard]] std::filesystem::path second() const {
    std::string name = path_.filename().string();
    return path_.parent_path() / name.insert(name.find('.'), "-2");
  }

  std::filesystem::path path_;
};

TEST_P(LineSinkFile, CanBeReadUpToItsLastFlushWhileItIsOpen) {
  auto sink = LineSink::create(path_);
  ASSERT_TRUE(sink) << sink.error().message;
  ASSERT_TRUE(sink->write_and_flush("ODOM 1 0 0 0 0 0 1 h 1\nODOM 2 0 0 0 0 0 2 h 2\n"));
  auto reader = CarmenReader::open(path_);
  ASSERT_TRUE(reader) << reader.error().message;
  int records = 0;
  while (reader->next()) {
    ++records;
  }
  EXPECT_EQ(records, 2);
}

TEST_P(LineSinkFile, NeverReplacesARecording) {
  auto first = LineSink::create(path_);
  ASSERT_TRUE(first);
  ASSERT_TRUE(first->write_and_flush("# first\n"));
  const auto next = LineSink::create(path_);
  ASSERT_TRUE(next) << next.error().message;
  EXPECT_EQ(first->path(), path_);
  EXPECT_EQ(next->path(), second());
}

INSTANTIATE_TEST_SUITE_P(PlainAndCompressed, LineSinkFile, ::testing::Values("sink.clf", "sink.clf.gz"));

TEST(LineSink, SaysThatADiskIsFullAndThatAFolderIsMissing) {
  auto full = LineSink::create("/dev/full");
  ASSERT_TRUE(full) << full.error().message;
  const Status written = full->write_and_flush("# text\n");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Errc::kIo);
  EXPECT_NE(written.error().message.find("No space left"), std::string::npos) << written.error().message;
  EXPECT_EQ(LineSink::create("/no/such/folder/drive.clf").error().code, Errc::kIo);
}

}  // namespace
}  // namespace seeker::drivers
