// From a drive to a robot file: recorded explorations of simulated robots with known errors, and a real Pioneer.

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/files/files.hpp"
#include "server/lab/calibration/calibration_command.hpp"
#include "server/lab/scoring/log_poses.hpp"
#include "server/lab/scoring/score_reference.hpp"
#include "server/lab/slam/slam_command.hpp"
#include "tests/support/data.hpp"
#include "tests/support/environment.hpp"
#include "tests/unit/server/lab/calibration/recorded_exploration.hpp"
#include "tests/unit/server/lab/experiments/files.hpp"

namespace seeker::lab {
namespace {

using calibration::CalibrationSubject;
using ::testing::HasSubstr;

class Calibration : public LabFiles {
 protected:
  [[nodiscard]] CalibrationOptions options_for(const std::filesystem::path& log,
                                               std::vector<std::string> overrides = {}) const {
    CalibrationOptions options;
    options.log = log;
    options.config = seeker::testing::source_file("config");
    options.overrides = std::move(overrides);
    options.json = true;
    return options;
  }
  [[nodiscard]] static nlohmann::json found(const CalibrationOptions& options, CalibrationSubject subject) {
    std::ostringstream out;
    const Status done = run_calibration(options, subject, out);
    EXPECT_TRUE(done) << done.error().message;
    return done ? nlohmann::json::parse(out.str()) : nlohmann::json();
  }
};

class CalibrationOfSeed : public Calibration, public ::testing::WithParamInterface<int> {};

TEST_P(CalibrationOfSeed, FindsWheelsThatDifferByThreePercentAndATrackThatIsTwoPercentOff) {
  const auto log = folder() / "drive.clf.gz";
  explore_and_record(log, static_cast<std::uint64_t>(GetParam()), 900.0,
                     {"sim.robot.odometry.left_wheel_scale=1.015", "sim.robot.odometry.right_wheel_scale=0.985",
                      "sim.robot.odometry.wheel_base_scale=1.02"});
  constexpr double kAssumedTrack_m = 0.357 * 1.02;
  const nlohmann::json fit =
      found(options_for(log, {"replay.laser.base_T_laser=[0.021, 0, 0]",
                              "odometry_calibration.track_m=" + std::to_string(kAssumedTrack_m)}),
            CalibrationSubject::kWheels);
  constexpr double kWithin = 0.003;
  EXPECT_NEAR(fit.at("left_scale").get<double>(), 1.0 / 1.015, kWithin) << fit;
  EXPECT_NEAR(fit.at("right_scale").get<double>(), 1.0 / 0.985, kWithin);
  EXPECT_NEAR(fit.at("track_scale").get<double>(), 1.0 / 1.02, kWithin);
  EXPECT_NEAR(fit.at("right_scale").get<double>() / fit.at("left_scale").get<double>(), 1.015 / 0.985, kWithin);
  EXPECT_LT(fit.at("track_scale_sigma").get<double>(), kWithin);
}

TEST_P(CalibrationOfSeed, FindsWhereTheLaserIsMounted) {
  const auto log = folder() / "drive.clf.gz";
  explore_and_record(log, static_cast<std::uint64_t>(GetParam()), 500.0,
                     {"sim.robot.lidar.base_T_laser=[0.15, -0.05, 12]"});
  // The robot file says that the laser is over the middle of the base and looks ahead.
  const nlohmann::json fit = found(options_for(log), CalibrationSubject::kMount);
  EXPECT_NEAR(fit.at("x_m").get<double>(), 0.15, 0.01) << fit;
  EXPECT_NEAR(fit.at("y_m").get<double>(), -0.05, 0.01);
  EXPECT_NEAR(fit.at("heading_deg").get<double>(), 12.0, 0.3);
}

/// Each explores for minutes of robot time: more seeds by `./run soak calibration`.
INSTANTIATE_TEST_SUITE_P(Seeds, CalibrationOfSeed,
                         ::testing::Range(1, 1 + seeker::testing::number_from_environment("SEEKER_CALIBRATIONS", 1)));

TEST_F(Calibration, RefusesARobotThatStandsAndOdometryAsItsOwnWitness) {
  const auto log = write("stand.clf",
                         "FLASER 3 1 2 3 0 0 0 0 0 0 100.0 h 100\n"
                         "FLASER 3 1 2 3 0 0 0 0 0 0 100.1 h 101\n");
  std::ostringstream out;
  const Status standing = run_calibration(options_for(log), CalibrationSubject::kWheels, out);
  ASSERT_FALSE(standing);
  EXPECT_EQ(standing.error().code, Errc::kNotReady);
  EXPECT_THAT(standing.error().message, HasSubstr("record a drive"));
  CalibrationOptions options = options_for(log);
  options.estimator = "odometry";
  EXPECT_EQ(run_calibration(options, CalibrationSubject::kWheels, out).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(out.str(), "");
}

/// Odometry alone over a log, with a robot file, against a localiser's poses.
ReferenceReport score_odometry(const std::filesystem::path& log, const std::filesystem::path& corrections,
                               const std::filesystem::path& robot, const std::filesystem::path& out_folder) {
  SlamOptions options;
  options.log = log;
  options.robot = robot;
  options.config = seeker::testing::source_file("config");
  options.estimator = "odometry";
  options.out = out_folder;
  std::ostringstream out;
  EXPECT_TRUE(run_slam_command(options, out));
  constexpr double kMaxGap_s = 0.5;
  const Trajectory trajectory = read_trajectory(out_folder / "trajectory.tum").value().poses;
  const Trajectory reference =
      apply_corrections(read_trajectory(corrections).value().poses, read_log_poses(log).value().odometry, kMaxGap_s);
  return score_reference(trajectory, reference, kMaxGap_s).value();
}

TEST_F(Calibration, MakesTheOdometryOfARealPioneerBetterAlsoOnADriveThatItHasNotSeen) {
  SEEKER_REQUIRE_DATA(data, "lidar/p3dx");
  CalibrationOptions options = options_for(data / "trace0.clf.gz");
  options.out = folder() / "calibration.yaml";
  (void)found(options, CalibrationSubject::kWheels);
  const std::filesystem::path raw_robot = seeker::testing::source_file("config/robots/replay-p3dx.yaml");
  const std::filesystem::path robot =
      write("robot.yaml", "base: " + raw_robot.string() + "\n" + read(folder() / "calibration.yaml"));
  for (const std::string& drive : {std::string("trace0"), std::string("trace1")}) {
    const auto log = data / (drive + ".clf.gz");
    const auto corrections = data / (drive + "_map_to_odom.csv.gz");
    const ReferenceReport raw = score_odometry(log, corrections, raw_robot, folder() / "raw");
    const ReferenceReport calibrated = score_odometry(log, corrections, robot, folder() / "calibrated");
    EXPECT_LT(calibrated.translation_rms_m, raw.translation_rms_m) << drive;
    EXPECT_LT(calibrated.rotation_rms_deg, raw.rotation_rms_deg) << drive;
  }
}

}  // namespace
}  // namespace seeker::lab
