#include "server/lab/slam/slam_run.hpp"

#include <sstream>

#include <gtest/gtest.h>

#include "server/lab/scoring/log_poses.hpp"
#include "server/lab/scoring/score_reference.hpp"
#include "server/lab/slam/log_geometry.hpp"
#include "server/lab/slam/slam_command.hpp"
#include "server/lab/slam/slam_final_poses.hpp"
#include "tests/support/data.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/drivers/replay/temporary_log.hpp"
#include "tests/unit/server/lab/experiments/files.hpp"

namespace seeker::lab {
namespace {

/// A log of three scans; the corrected poses in it are far from the odometry.
constexpr const char* kLog =
    "ODOM 0 0 0 0 0 0 99.9 h 99.9\n"
    "FLASER 3 1 2 3 50 50 1 0 0 0 100.000001 h 100\n"
    "FLASER 3 1 2 broken\n"
    "FLASER 3 1 2 3 60 50 1 1 0 0 101.5 h 101\n"
    "FLASER 3 1 2 3 70 50 1 1 1 1.5 103.25 h 102\n";

/// Says what it was given: lost at the second scan, refuses nothing.
class Recorder final : public slam::PoseTracker {
 public:
  Status predict(const Pose2& odom_T_base, RobotTime /*stamp*/) override {
    estimate_.map_T_base = odom_T_base;
    return {};
  }
  Status update(const LaserScan& scan) override {
    ++scans;
    estimate_.quality = scans == 2 ? LocalisationQuality::kLost : LocalisationQuality::kLocalised;
    ranges_m.push_back(scan.ranges_m);
    return scans == 3 ? Status(fail(Errc::kInvalidArgument, "the third is refused")) : Status{};
  }
  [[nodiscard]] PoseEstimate estimate() const override { return estimate_; }
  void reset(const Pose2& /*map_T_base*/) override {}

  int scans = 0;
  std::vector<std::vector<float>> ranges_m;

 private:
  PoseEstimate estimate_;
};

class SlamRunOf : public LabFiles {};

TEST_F(SlamRunOf, ALogGivesEveryScanItsOdometryAndKeepsCorrectedPosesBack) {
  Recorder tracker;
  const auto run = run_slam(write("log.clf", kLog), {}, tracker);
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(tracker.scans, 3);
  EXPECT_EQ(tracker.ranges_m.front(), (std::vector<float>{1.0F, 2.0F, 3.0F}));
  EXPECT_EQ(run->online,
            (Trajectory{{100.000001, {0.0, 0.0, 0.0}}, {101.5, {1.0, 0.0, 0.0}}, {103.25, {1.0, 1.0, 1.5}}}));
  EXPECT_EQ(run->trajectory, run->online);
  EXPECT_EQ(run->log.bad, 1U);
  EXPECT_EQ(run->refused, 1U);
  EXPECT_EQ(run->first_refusal, "the third is refused");
}

TEST_F(SlamRunOf, ALogCountsQualitiesWithTheirTimes) {
  Recorder tracker;
  const auto run = run_slam(write("log.clf", kLog), {}, tracker);
  ASSERT_TRUE(run);
  ASSERT_EQ(run->spells.size(), 3U);
  EXPECT_EQ(run->spells[1].from_s, 101.5);
  const QualityShare lost = share_of(*run, LocalisationQuality::kLost);
  EXPECT_EQ(lost.scans, 1U);
  EXPECT_NEAR(lost.time_s, 1.75, 1e-6);
  EXPECT_EQ(share_of(*run, LocalisationQuality::kLocalised).scans, 2U);
  EXPECT_EQ(share_of(*run, LocalisationQuality::kDegraded).scans, 0U);
  EXPECT_GE(run->cost.scan.max_ms, run->cost.scan.median_ms);
  EXPECT_GE(run->cost.memory_peak_mb, run->cost.memory_empty_mb);
}

TEST_F(SlamRunOf, ALogWithoutScansIsRefused) {
  Recorder tracker;
  EXPECT_EQ(run_slam(write("odom.clf", "ODOM 0 0 0 0 0 0 1 h 1\n"), {}, tracker).error().code, Errc::kParse);
  EXPECT_EQ(run_slam(folder() / "none.clf", {}, tracker).error().code, Errc::kNotFound);
}

TEST_F(SlamRunOf, ALogIsWalkedOnceMoreAtTheFinalPoses) {
  const auto log = write("log.clf", kLog);
  const Trajectory trajectory = {{100.000001, {1.0, 0.0, 0.0}}, {103.25, {3.0, 0.0, 0.0}}};
  std::vector<double> x_m;
  ASSERT_TRUE(
      for_each_scan(log, {}, trajectory, [&](const LaserScan&, const Pose2& pose) { x_m.push_back(pose.x_m); }));
  EXPECT_EQ(x_m, (std::vector<double>{1.0, 3.0}));
}

TEST_F(SlamRunOf, TheCommandChoosesTheGeometryAndWritesItsFiles) {
  SlamOptions options;
  options.log = write("log.clf", kLog);
  options.out = folder() / "out";
  options.config = testing::source_file("config");
  options.estimator = "odometry";
  options.json = true;
  std::ostringstream out;
  const Status done = run_slam_command(options, out);
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(read(folder() / "out" / "report.json"), out.str());
  EXPECT_NE(out.str().find("\"robot_file\": \"replay.yaml\""), std::string::npos);
  EXPECT_NE(out.str().find("\"bad_lines\": 1"), std::string::npos);
  const auto written = read_trajectory(folder() / "out" / "trajectory.tum");
  ASSERT_TRUE(written);
  EXPECT_EQ(written->poses.size(), 3U);
  EXPECT_TRUE(std::filesystem::exists(folder() / "out" / "map.png"));
  EXPECT_FALSE(std::filesystem::exists(folder() / "out" / "trajectory_online.tum"));
  options.estimator = "none";
  EXPECT_EQ(run_slam_command(options, out).error().code, Errc::kNotFound);
}

TEST_F(SlamRunOf, TheCommandTellsOfALogThatEndsEarlyAndKeepsWhatItGave) {
  const drivers::TemporaryLog whole("whole.clf", kLog, true);
  // A gzip file ends with 8 bytes of checksum and length.
  std::filesystem::resize_file(whole.path(), std::filesystem::file_size(whole.path()) - 8);
  SlamOptions options;
  options.log = whole.path();
  options.out = folder() / "out";
  options.config = testing::source_file("config");
  options.estimator = "odometry";
  std::ostringstream out;
  const Status done = run_slam_command(options, out);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::kCorrupt);
  EXPECT_NE(done.error().message.find("the log ends early"), std::string::npos) << done.error().message;
  const auto written = read_trajectory(folder() / "out" / "trajectory.tum");
  ASSERT_TRUE(written);
  EXPECT_EQ(written->poses.size(), 3U);
}

TEST_F(SlamRunOf, TheGeometryIsChosenByTheFirstScan) {
  std::string urg = "FLASER 726";
  for (int k = 0; k < 726; ++k) {
    urg += " 1.5";
  }
  EXPECT_EQ(robot_file_for(write("a", kLog)).value(), "replay.yaml");
  EXPECT_EQ(robot_file_for(write("b", "rubbish\n" + urg + " 0 0 0 0 0 0 1 h 1\n")).value(), "replay-p3dx.yaml");
  EXPECT_EQ(robot_file_for(write("c", "# scans\n1.5,0,0,0,1,1,1\n")).value(), "replay-rplidar.yaml");
  EXPECT_EQ(robot_file_for(write("d", "# nothing\n")).error().code, Errc::kParse);
}

MapKeyframe keyframe(double stamp_s, std::uint32_t node, const Pose2& node_T_base) {
  MapKeyframe value;
  value.stamp = robot_time_s(stamp_s);
  value.node = node;
  value.node_T_base = node_T_base;
  return value;
}

TEST(FinalPoses, FollowTheKeptScansAndTheOnlineMotionBetween) {
  std::vector<OnlinePose> online;
  for (int k = 0; k <= 4; ++k) {
    online.push_back({robot_time_s(k), {1.0 * k, 0.0, 0.0}, 0});
  }
  LineMap map;
  map.nodes = {{1, {0.0, 10.0, 0.0}, {}}, {2, {2.0, 12.0, 0.0}, {}}};
  map.keyframes = {keyframe(1.0, 1, {1.0, 0.0, 0.0}), keyframe(3.0, 2, {1.0, 0.0, 0.0})};
  const std::vector<Pose2> poses = final_poses(online, map);
  ASSERT_EQ(poses.size(), 5U);
  const double y_m[] = {10.0, 10.0, 11.0, 12.0, 12.0};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_THAT(poses[k], testing::Pose2Near(Pose2{1.0 * static_cast<double>(k), y_m[k], 0.0}, 1e-12, 1e-12)) << k;
  }
}

TEST(FinalPoses, DoNotCarryOverAJumpOfTheMap) {
  std::vector<OnlinePose> online = {{robot_time_s(0.0), {0.0, 0.0, 0.0}, 0},
                                    {robot_time_s(1.0), {1.0, 0.0, 0.0}, 0},
                                    {robot_time_s(2.0), {2.0, 5.0, 0.0}, 1},
                                    {robot_time_s(3.0), {3.0, 5.0, 0.0}, 1}};
  LineMap map;
  map.nodes = {{1, {}, {}}};
  map.keyframes = {keyframe(0.0, 1, {0.0, 5.0, 0.0}), keyframe(3.0, 1, {3.0, 5.0, 0.0})};
  const std::vector<Pose2> poses = final_poses(online, map);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_THAT(poses[k], testing::Pose2Near(Pose2{1.0 * static_cast<double>(k), 5.0, 0.0}, 1e-12, 1e-12)) << k;
  }
}

TEST(FinalPoses, StayWhereThereIsNoMap) {
  const std::vector<OnlinePose> online = {{robot_time_s(0.0), {1.0, 2.0, 3.0}, 0}};
  EXPECT_EQ(final_poses(online, {}), (std::vector<Pose2>{{1.0, 2.0, 3.0}}));
}

TEST_F(SlamRunOf, ARealPioneersScanMatchingStaysNearItsLocaliser) {
  SEEKER_REQUIRE_DATA(log, "lidar/p3dx/trace0.clf.gz");
  SEEKER_REQUIRE_DATA(corrections, "lidar/p3dx/trace0_map_to_odom.csv.gz");
  SlamOptions options;
  options.log = log;
  options.out = folder() / "out";
  options.config = testing::source_file("config");
  std::ostringstream out;
  const Status done = run_slam_command(options, out);
  ASSERT_TRUE(done) << done.error().message;
  const auto poses = read_trajectory(options.out / "trajectory.tum");
  const auto odometry = read_log_poses(log);
  const auto localiser = read_trajectory(corrections);
  ASSERT_TRUE(poses && odometry && localiser);
  const Trajectory reference = apply_corrections(localiser->poses, odometry->odometry, 0.5);
  const auto report = score_reference(poses->poses, reference, 0.5);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_GT(report->used, 900U);
  EXPECT_LT(report->translation_rms_m, 0.3);
}

}  // namespace
}  // namespace seeker::lab
