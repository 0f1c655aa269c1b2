#include "server/drivers/replay/replay.hpp"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/data.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/drivers/replay/temporary_log.hpp"

namespace seeker::drivers {
namespace {

constexpr const char* kScan = "FLASER 3 1.0 2.5 81.91 9 9 9 0.1 0.2 0.3 100.5 robot 100.6";
constexpr const char* kLog =
    "# a comment\n"
    "PARAM robot_front_laser_max 81.92\n"
    "ODOM 1 2 0.5 0.3 0.1 0 100.0 robot 100.0\n"
    "FLASER 3 1.0 2.5 81.91 9 9 9 1.1 2.0 0.5 100.5 robot 100.6\r\n"
    "FLASER 3 1.0 2.5 81.9\n"
    "FLASER 3 1.1 0.001 80.0 9 9 9 1.2 2.0 0.5 101.0 robot 101.0\n"
    "FLASER 3 1.1 2.5 3.0 9 9 9 1.3 2.0 0.5 99.0 robot 99.0\n"
    "ODOM 1 2 nan 0 0 0 101.0 robot 101.0\n";

TEST(CarmenLine, ReadsEachRecordType) {
  const auto scan = parse_carmen_line(kScan);
  ASSERT_TRUE(scan && *scan);
  const auto& laser = std::get<CarmenScan>(**scan);
  EXPECT_EQ(laser.ranges_m, (std::vector<float>{1.0F, 2.5F, 81.91F}));
  EXPECT_EQ(laser.stamp_s, 100.5);
  EXPECT_THAT(*laser.odom_T_base, testing::Pose2Near(Pose2{0.1, 0.2, 0.3}, 1e-12, 1e-12));

  const auto odometry = parse_carmen_line("ODOM 1 2 0.5 0.3 0.1 0 100.0 robot 100.0");
  ASSERT_TRUE(odometry && *odometry);
  EXPECT_EQ(std::get<CarmenOdometry>(**odometry).velocity, (Twist2{0.3, 0.1}));

  const auto raw = parse_carmen_line("RAWLASER1 0 -1.57 3.14 1.57 80 0.01 0 2 1.5 2.5 1 7 50.0 host 50.0");
  ASSERT_TRUE(raw && *raw);
  EXPECT_EQ(std::get<CarmenScan>(**raw).angle_min_rad, -1.57);
  EXPECT_EQ(std::get<CarmenScan>(**raw).angle_step_rad, 1.57);
  EXPECT_FALSE(std::get<CarmenScan>(**raw).odom_T_base);

  const auto robot =
      parse_carmen_line("ROBOTLASER1 0 -1.57 3.14 1.57 80 0.01 0 2 1.5 2.5 0 1 2 3 4 5 0.6 0 0 1 1 0 50.0 host 50.0");
  ASSERT_TRUE(robot && *robot);
  EXPECT_THAT(*std::get<CarmenScan>(**robot).odom_T_base, testing::Pose2Near(Pose2{4.0, 5.0, 0.6}, 1e-12, 1e-12));
}

TEST(CarmenLine, AStatedMaximumIsNoEcho) {
  const auto record = parse_carmen_line("RAWLASER1 0 -1.57 3.14 1.57 8.0 0.01 0 3 1.5 8.0 7.5 0 50.0 host 50.0");
  ASSERT_TRUE(record && *record);
  const LaserScan scan = to_laser_scan(std::get<CarmenScan>(**record), {}, {});
  EXPECT_EQ(scan.range_max_m, 8.0);
  EXPECT_EQ(scan.ranges_m[0], 1.5F);
  EXPECT_EQ(scan.ranges_m[1], kNoReturn);
  EXPECT_EQ(scan.ranges_m[2], 7.5F);
}

TEST(CarmenLine, AStepThatContradictsTheFieldOfViewIsNotBelieved) {
  // Five beams over 180 degrees; a converter wrote one degree between them, or nothing.
  for (const char* step : {"0.017453", "0"}) {
    const auto record = parse_carmen_line(std::string("RAWLASER1 0 -1.5708 3.1416 ") + step +
                                          " 80 0.01 0 5 1 1 1 1 1 0 50.0 host 50.0");
    ASSERT_TRUE(record && *record) << step;
    EXPECT_NEAR(*std::get<CarmenScan>(**record).angle_step_rad, kPi / 4.0, 1e-4) << step;
  }
}

TEST(CarmenLine, FrontLasersAreKnownByTheirBeams) {
  const auto scan_of = [](std::size_t beams) {
    CarmenScan scan;
    scan.ranges_m.assign(beams, 1.0F);
    return to_laser_scan(scan, {}, {});
  };
  const auto last_rad = [](const LaserScan& scan) { return scan.angle_rad(scan.ranges_m.size() - 1); };
  for (const auto& [beams, half_deg] :
       {std::pair{181U, 90.0}, {361U, 90.0}, {541U, 135.0}, {683U, 120.0}, {1081U, 135.0}, {401U, 50.0}}) {
    EXPECT_NEAR(scan_of(beams).angle_min_rad, -deg_to_rad(half_deg), 1e-9) << beams;
    EXPECT_NEAR(last_rad(scan_of(beams)), deg_to_rad(half_deg), 1e-9) << beams;
  }
  EXPECT_NEAR(scan_of(180).angle_step_rad, deg_to_rad(1.0), 1e-9) << "the last beam is left out";
}

TEST(CarmenLine, IgnoresWhatItDoesNotUse) {
  for (const char* line : {"", "   ", "# hello", "PARAM a b", "SYNC x", "NMEAGGA 1 2 3"}) {
    const auto record = parse_carmen_line(line);
    EXPECT_TRUE(record && !*record) << line;
  }
}

TEST(CarmenLine, EveryCutOfALineIsRefused) {
  const std::string whole = kScan;
  for (std::size_t length = 7; length < whole.size() - 5; ++length) {
    const auto record = parse_carmen_line(std::string_view(whole).substr(0, length));
    EXPECT_FALSE(record) << whole.substr(0, length);
  }
}

TEST(CarmenLine, RefusesImpossibleCountsAndNumbers) {
  EXPECT_EQ(parse_carmen_line("FLASER 99999999 1 2 3").error().code, Errc::kTooLarge);
  EXPECT_EQ(parse_carmen_line("FLASER -1 1").error().code, Errc::kTooLarge);
  EXPECT_EQ(parse_carmen_line("FLASER 1 far 0 0 0 0 0 0 1 h 1").error().code, Errc::kParse);
  EXPECT_EQ(parse_carmen_line("FLASER 1 2 inf 0 0 0 0 0 1 h 1").error().code, Errc::kParse);
  EXPECT_EQ(parse_carmen_line("FLASER 1 1e999 0 0 0 0 0 0 1 h 1").error().code, Errc::kParse);
  EXPECT_EQ(parse_carmen_line("1.02 1.03 0.5").error().code, Errc::kParse);
}

TEST(CarmenLine, ABeamWithoutEchoMayBeWrittenAsInfOrNan) {
  const auto scan = parse_carmen_line("FLASER 5 1.5 inf nan -nan -inf 9 9 9 0.1 0.2 0.3 100.5 robot 100.6");
  ASSERT_TRUE(scan && *scan);
  EXPECT_EQ(std::get<CarmenScan>(**scan).ranges_m, (std::vector<float>{1.5F, kNoReturn, 0.0F, 0.0F, 0.0F}));
}

TEST(CarmenReader, WhatPARAMSaysOfTheLasersReachHoldsForScansThatDoNotSayIt) {
  const TemporaryLog log("reach.clf",
                         "FLASER 1 1.0 9 9 9 0.1 0.2 0.3 1.0 h 1.0\n"
                         "PARAM laser_front_laser_max_range 8.19\n"
                         "PARAM robot_front_laser_max 50\n"
                         "PARAM laser_front_laser_max_range -1\n"
                         "PARAM robot_front_laser_max far\n"
                         "FLASER 1 8.19 9 9 9 0.1 0.2 0.3 2.0 h 2.0\n");
  auto reader = CarmenReader::open(log.path());
  ASSERT_TRUE(reader) << reader.error().message;
  auto record = reader->next();
  ASSERT_TRUE(record);
  EXPECT_FALSE(std::get<CarmenScan>(*record).range_max_m);
  record = reader->next();
  ASSERT_TRUE(record);
  const auto& scan = std::get<CarmenScan>(*record);
  EXPECT_EQ(scan.range_max_m, 8.19);
  EXPECT_EQ(to_laser_scan(scan, {}, {}).ranges_m.front(), kNoReturn);
  EXPECT_EQ(reader->summary().bad, 0U);
}

TEST(LineFile, AByteOrderMarkOfUtf8IsPassedOverAndUtf16IsRefused) {
  for (const bool compressed : {false, true}) {
    const TemporaryLog marked("marked.clf", std::string("\xEF\xBB\xBF") + "first\nsecond\n", compressed);
    auto file = LineFile::open(marked.path());
    ASSERT_TRUE(file) << file.error().message;
    std::string line;
    ASSERT_EQ(file->next(line), LineFile::Line::kGood);
    EXPECT_EQ(line, "first");
    const TemporaryLog plain("plain.clf", "no", compressed);
    auto shorter = LineFile::open(plain.path());
    ASSERT_TRUE(shorter) << shorter.error().message;
    ASSERT_EQ(shorter->next(line), LineFile::Line::kGood);
    EXPECT_EQ(line, "no");
    const TemporaryLog wide("wide.clf", std::string("\xFF\xFE") + "f", compressed);
    EXPECT_EQ(LineFile::open(wide.path()).error().code, Errc::kParse);
  }
}

/// Takes all records; nobody reads them.
void play_to_end(ReplaySource& source) {
  while (source.advance_one()) {
  }
}

TEST(Replay, DeliversInRobotTimeAndCountsBadLines) {
  const TemporaryLog log("basic", kLog);
  auto source = ReplaySource::open(log.path());
  ASSERT_TRUE(source) << source.error().message;
  ReplayClock clock(*source, 0.0);
  ReplayBase base(*source);
  ReplayLidar lidar(*source);
  EXPECT_TRUE(clock.lockstep());
  ASSERT_TRUE(clock.advance(seconds(0.1)));
  EXPECT_FALSE(lidar.read()->has_value());
  const auto first = base.read().value();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->odom_T_base, (Pose2{1.0, 2.0, 0.5}));
  EXPECT_FALSE(base.read()->has_value());
  for (int k = 0; k < 4; ++k) {
    ASSERT_TRUE(clock.advance(seconds(0.1)));
  }
  const auto scan = lidar.read().value();
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->stamp, robot_time_s(0.5));
  EXPECT_EQ(scan->ranges_m, (std::vector<float>{1.0F, 2.5F, kNoReturn}));
  EXPECT_NEAR(scan->angle_step_rad, kPi / 2.0, 1e-12);
  EXPECT_TRUE(validate(*scan));
  const auto sample = base.read().value();
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->stamp, scan->stamp);  // the scan's own odometry
  while (clock.advance(seconds(0.1))) {
  }
  const auto last = lidar.read().value();
  ASSERT_TRUE(last);
  EXPECT_EQ(last->ranges_m, (std::vector<float>{1.1F, kNoReturn, kNoReturn}));
  EXPECT_EQ(last->quality, (std::vector<std::uint8_t>{1, 0, 1}));
  EXPECT_EQ(clock.advance(seconds(0.1)).error().code, Errc::kCancelled);
  const ReplaySummary& summary = (*source)->summary();
  EXPECT_TRUE((*source)->finished());
  EXPECT_EQ(summary.scans, 2U);
  EXPECT_EQ(summary.odometry, 1U);
  EXPECT_EQ(summary.ignored, 2U);
  EXPECT_EQ(summary.bad, 3U);
  ASSERT_EQ(summary.examples.size(), 3U);
  EXPECT_EQ(summary.examples[0].number, 5U);
  EXPECT_EQ(summary.examples[1].number, 7U);
  EXPECT_NEAR(summary.duration_s, 1.0, 1e-9);
  EXPECT_NE(describe(summary).find("2 scans"), std::string::npos);
}

TEST(Replay, ReadsCompressedLogsAlike) {
  const TemporaryLog log("gz", kLog, true);
  auto source = ReplaySource::open(log.path());
  ASSERT_TRUE(source);
  play_to_end(**source);
  EXPECT_EQ((*source)->summary().scans, 2U);
  EXPECT_EQ((*source)->summary().overtaken, 1U) << "nobody read the first scan";
}

TEST(Replay, GivesEveryScanToAReaderWhoLooksOnceATick) {
  std::string text;
  constexpr int kScans = 40;
  for (int k = 0; k < kScans; ++k) {
    text += "FLASER 2 1.0 1.0 0 0 0 0 0 0 " + std::to_string(0.03 * k) + " robot 1.0\n";  // three in a tick
  }
  const TemporaryLog log("dense", text);
  auto source = ReplaySource::open(log.path());
  ASSERT_TRUE(source);
  int seen = 0;
  for (int tick = 0; tick < 2 * kScans && !(*source)->finished(); ++tick) {
    (*source)->advance_to((*source)->now() + seconds(0.1));
    seen += (*source)->take_scan() ? 1 : 0;
  }
  EXPECT_EQ(seen, kScans);
  EXPECT_EQ((*source)->summary().overtaken, 0U);
}

TEST(Replay, AScanWithoutOdometryOfItsOwnMeetsThatOfBefore) {
  std::string text;
  for (int k = 0; k < 20; ++k) {  // the wheels tell ten times in a tick, the scan lies in the middle of them
    const std::string stamp = std::to_string(0.01 * k);
    text += "ODOM " + std::to_string(0.005 * k) + " 0 0 0 0 0 " + stamp + " robot 1.0\n";
    if (k == 14) {
      text += "RAWLASER1 0 -1.5708 3.1416 1.0472 80 0.01 0 4 1.0 1.0 1.0 1.0 0 " + stamp + " robot 1.0\n";
    }
  }
  const TemporaryLog log("between", text);
  auto source = ReplaySource::open(log.path());
  ASSERT_TRUE(source) << source.error().message;
  std::optional<LaserScan> scan;
  std::optional<OdometrySample> odometry;
  while (!scan && !(*source)->finished()) {
    (*source)->advance_to((*source)->now() + seconds(0.1));
    scan = (*source)->take_scan();
    odometry = (*source)->take_odometry();
  }
  ASSERT_TRUE(scan && odometry);
  EXPECT_NEAR(odometry->odom_T_base.x_m, 0.005 * 14, 1e-9);
  EXPECT_EQ(odometry->stamp, scan->stamp);
}

TEST(Replay, ACutCompressedLogIsReadAsFarAsItGoes) {
  std::string text;
  for (int k = 0; k < 5000; ++k) {
    text += "ODOM " + std::to_string(k * 7919 % 1000) + " 2 0.5 0 0 0 " + std::to_string(k) + ".0 robot 1.0\n";
  }
  const TemporaryLog log("cut", text, true);
  std::filesystem::resize_file(log.path(), std::filesystem::file_size(log.path()) / 2);
  auto source = ReplaySource::open(log.path());
  ASSERT_TRUE(source);
  (*source)->advance_to(robot_time_s(1e4));
  EXPECT_GT((*source)->summary().odometry, 100U);
  EXPECT_FALSE((*source)->summary().damage.empty());
}

TEST(Replay, ALineWithoutEndIsBoundedAndCounted) {
  const TemporaryLog log("long", std::string(2 * CarmenReader::kMaxLine_bytes, '7') + "\n" + kScan + "\n");
  auto source = ReplaySource::open(log.path());
  ASSERT_TRUE(source);
  EXPECT_EQ((*source)->summary().bad, 1U);
  EXPECT_EQ((*source)->summary().scans, 1U);
}

TEST(Replay, RefusesToDriveAndFilesThatAreNoLogs) {
  const TemporaryLog log("drive", std::string(kScan) + "\n");
  ReplayBase base(*ReplaySource::open(log.path()));
  EXPECT_EQ(base.set_velocity({0.1, 0.0}, {}).error().code, Errc::kRefused);
  EXPECT_TRUE(base.set_velocity({}, {}));
  EXPECT_EQ(base.set_motors(true).error().code, Errc::kRefused);
  EXPECT_EQ(base.drivable().error().code, Errc::kRefused);
  EXPECT_EQ(ReplaySource::open("/nonexistent/file.clf").error().code, Errc::kNotFound);
  const TemporaryLog noise("noise", "hello\nworld 1 2 3\n");
  EXPECT_EQ(ReplaySource::open(noise.path()).error().code, Errc::kParse);
}

TEST(Replay, ReadsTheRecordedLogsWhole) {
  SEEKER_REQUIRE_DATA(pioneer, "lidar/p3dx/trace0.clf.gz");
  SEEKER_REQUIRE_DATA(freiburg, "lidar/fr079.clf.gz");
  auto source = ReplaySource::open(pioneer);
  ASSERT_TRUE(source);
  play_to_end(**source);
  EXPECT_EQ((*source)->summary().scans, 958U) << describe((*source)->summary());
  auto other = ReplaySource::open(freiburg);
  ASSERT_TRUE(other);
  play_to_end(**other);
  EXPECT_EQ((*other)->summary().scans + (*other)->summary().bad, 4791U) << describe((*other)->summary());
  EXPECT_LT((*other)->summary().bad, 50U) << describe((*other)->summary());
}

TEST(SignalQuality, OfTheLogIsThatOfTheScan) {
  CarmenScan logged;
  logged.ranges_m = {1.0F, 2.0F, 0.001F, 90.0F};
  EXPECT_EQ(to_laser_scan(logged, {}, {}).quality, (std::vector<std::uint8_t>{1, 1, 0, 1})) << "the log has none";
  logged.strengths = {47.0F, 300.0F, 9.0F, 0.0F};
  EXPECT_EQ(to_laser_scan(logged, {}, {}).quality, (std::vector<std::uint8_t>{47, 255, 0, 1}));
  logged.strengths = {1.0F, 0.5F, 0.2F, 0.0F};
  EXPECT_EQ(to_laser_scan(logged, {}, {}).quality, (std::vector<std::uint8_t>{255, 128, 0, 1})) << "shares of 1";
}

TEST(SignalQuality, IsReadFromTheRemissionsOfARobotLaser) {
  const auto record = parse_carmen_line("RAWLASER1 0 -0.1 0.2 0.1 8 0.01 0 3 1.0 1.1 1.2 3 12 0 40 7.5 host 7.5");
  ASSERT_TRUE(record && *record);
  EXPECT_EQ(std::get<CarmenScan>(**record).strengths, (std::vector<float>{12.0F, 0.0F, 40.0F}));
  const auto none = parse_carmen_line("RAWLASER1 0 -0.1 0.2 0.1 8 0.01 0 3 1.0 1.1 1.2 3 0 0 0 7.5 host 7.5");
  ASSERT_TRUE(none && *none);
  EXPECT_TRUE(std::get<CarmenScan>(**none).strengths.empty()) << "zeros stand for none";
}

}  // namespace
}  // namespace seeker::drivers
