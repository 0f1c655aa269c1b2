#include "server/app/robot/drive_recorder.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "server/app/composition/robot_assembly.hpp"
#include "server/app/robot/robot.hpp"
#include "server/drivers/replay/replay.hpp"
#include "tests/support/carmen_scans.hpp"
#include "tests/support/data.hpp"

namespace seeker::app {
namespace {

constexpr double kEpoch_s = 1795867240.25;

class DriveRecorderTest : public ::testing::Test {
 public:
  ~DriveRecorderTest() override { std::filesystem::remove_all(folder_); }

 protected:
  [[nodiscard]] std::unique_ptr<DriveRecorder> recorder(const std::string& name, double epoch_s = kEpoch_s,
                                                        const DriveRecorderParams& params = {}) {
    auto made = DriveRecorder::create(folder_ / name, "r1", epoch_s, params);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
  }
  [[nodiscard]] static drivers::OdometrySample odometry_at(double stamp_s, const Pose2& odom_T_base) {
    drivers::OdometrySample sample;
    sample.stamp = robot_time_s(stamp_s);
    sample.odom_T_base = odom_T_base;
    return sample;
  }
  [[nodiscard]] static LaserScan scan_at(double stamp_s, float range_m) {
    LaserScan scan;
    scan.stamp = robot_time_s(stamp_s);
    scan.angle_min_rad = -0.1;
    scan.angle_step_rad = 0.1;
    scan.range_max_m = 8.0;
    scan.ranges_m = {range_m, kNoReturn, 3.0F};
    return scan;
  }
  [[nodiscard]] std::vector<drivers::CarmenScan> scans_of(const std::string& name) const {
    auto scans = testing::carmen_scans(folder_ / name);
    EXPECT_TRUE(scans);
    return scans ? std::move(*scans) : std::vector<drivers::CarmenScan>();
  }

  std::filesystem::path folder_ = [] {
    auto folder = std::filesystem::temp_directory_path() / ("seeker_recorder_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    return folder;
  }();
};

TEST_F(DriveRecorderTest, WritesEachScanWithTheOdometryAtItsOwnStamp) {
  auto drive = recorder("drive.clf.gz");
  drive->add(odometry_at(1.0, {1.0, 0.0, 0.0}));
  drive->add(scan_at(1.05, 2.0F));  // newer than the odometry: waits for the next one
  drive->add(odometry_at(1.1, {2.0, 0.0, 0.0}));
  drive->add(scan_at(1.1, 2.5F));
  drive.reset();
  const auto scans = scans_of("drive.clf.gz");
  ASSERT_EQ(scans.size(), 2U);
  ASSERT_TRUE(scans[0].odom_T_base && scans[1].odom_T_base);
  EXPECT_NEAR(scans[0].odom_T_base->x_m, 1.5, 1e-9);
  EXPECT_NEAR(scans[0].stamp_s, kEpoch_s + 1.05, 1e-6);
  EXPECT_EQ(scans[0].ranges_m, (std::vector<float>{2.0F, 8.0F, 3.0F}));
  EXPECT_EQ(scans[1].odom_T_base->x_m, 2.0);
}

TEST_F(DriveRecorderTest, WritesScansOfABaseThatHasFallenSilent) {
  auto drive = recorder("drive.clf");
  drive->add(odometry_at(1.0, {1.0, 0.0, 0.0}));
  constexpr int kScans = 30;
  for (int k = 0; k < kScans; ++k) {
    drive->add(scan_at(1.1 + 0.1 * k, 2.0F));
  }
  drive.reset();
  EXPECT_EQ(scans_of("drive.clf").size(), static_cast<std::size_t>(kScans));
}

TEST_F(DriveRecorderTest, LosesNothingThatWasFlushedWhenItIsKilled) {
  DriveRecorderParams params;
  params.flush_period = std::chrono::milliseconds(0);  // each reading at once
  params.pieces_waiting = 1000;
  std::filesystem::create_directories(folder_ / "copy");
  auto drive = recorder("drive.clf.gz", kEpoch_s, params);
  for (int k = 0; k < 200; ++k) {
    drive->add(odometry_at(0.1 * k, {0.01 * k, 0.0, 0.0}));
    drive->add(scan_at(0.1 * k, 2.0F));
  }
  // What is on the disk while the recorder still runs, once it has got so far.
  std::size_t on_disk = 0;
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (on_disk < 100 && std::chrono::steady_clock::now() < limit) {
    std::filesystem::copy_file(folder_ / "drive.clf.gz", folder_ / "copy" / "drive.clf.gz",
                               std::filesystem::copy_options::overwrite_existing);
    on_disk = scans_of("copy/drive.clf.gz").size();
  }
  EXPECT_GE(on_disk, 100U);
}

TEST_F(DriveRecorderTest, SaysOnceThatTheDiskIsFullAndGoesOn) {
  auto full = DriveRecorder::create("/dev/full", "r1", 0.0,
                                    {.flush_period = std::chrono::milliseconds(0), .pieces_waiting = 1000});
  ASSERT_TRUE(full);
  std::mutex mutex;
  std::vector<Error> errors;
  (*full)->set_on_error([&](const Error& error) {
    const std::lock_guard lock(mutex);
    errors.push_back(error);
  });
  for (int k = 0; k < 100; ++k) {
    (*full)->add(odometry_at(0.1 * k, {}));
  }
  full->reset();
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors.front().code, Errc::kIo);
}

TEST_F(DriveRecorderTest, SaysOnceThatTheDiskIsTooSlowAndKeepsNoMoreThanItMay) {
  auto drive = DriveRecorder::create(folder_ / "drive.clf", "r1", 0.0,
                                     {.flush_period = std::chrono::milliseconds(0), .pieces_waiting = 0});
  ASSERT_TRUE(drive);
  std::vector<Error> errors;
  (*drive)->set_on_error([&](const Error& error) { errors.push_back(error); });
  for (int k = 0; k < 100; ++k) {
    (*drive)->add(odometry_at(0.1 * k, {}));
  }
  drive->reset();
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors.front().code, Errc::kBusy);
}

TEST_F(DriveRecorderTest, RecordsWhatASimulatedRobotDrivesOn) {
  const RobotOptions options = load_robot_options(testing::source_file("config/robots/sim.yaml")).value();
  Assembly assembly = assemble(options).value();
  const sim::Simulation& simulation = *assembly.simulation;
  UpdateHub hub;
  auto drive = recorder("drive.clf.gz", 0.0);
  std::vector<std::pair<double, Pose2>> truth;
  {
    RobotLoop loop(options.loop, std::move(assembly.parts), hub);
    drive->follow(loop.hooks());
    loop.start();
    for (int k = 0; k < 50; ++k) {
      truth.emplace_back(to_seconds(loop.now()), simulation.odometry().odom_T_base);
      loop.tick({});
    }
  }
  drive.reset();
  const auto scans = scans_of("drive.clf.gz");
  ASSERT_GE(scans.size(), 50U);
  for (std::size_t k = 0; k < 50; ++k) {
    EXPECT_NEAR(scans[k].stamp_s, truth[k].first, 1e-6);
    EXPECT_EQ(scans[k].odom_T_base, truth[k].second);
    EXPECT_EQ(scans[k].ranges_m.size(), 361U);
  }
}

TEST_F(DriveRecorderTest, AFullDiskIsAWarningOfTheRobot) {
  const RobotOptions options = load_robot_options(testing::source_file("config/robots/sim.yaml")).value();
  Robot robot({}, options.loop, assemble(options).value().parts);
  robot.record(
      std::move(*DriveRecorder::create("/dev/full", "r1", 0.0, {.flush_period = std::chrono::milliseconds(0)})));
  std::mutex mutex;
  std::vector<api::Event> events;
  robot.loop().hooks().on_event = [&](const api::Event& event) {
    const std::lock_guard lock(mutex);
    events.push_back(event);
  };
  const auto is_told = [&] {
    const std::lock_guard lock(mutex);
    return std::any_of(events.begin(), events.end(), [](const api::Event& event) {
      return event.text.find("recording-failed") != std::string::npos && event.severity == api::Severity::kWarning;
    });
  };
  robot.start();
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!is_told() && std::chrono::steady_clock::now() < limit) {
    std::this_thread::yield();
  }
  EXPECT_TRUE(is_told());
  robot.stop();
}

}  // namespace
}  // namespace seeker::app
