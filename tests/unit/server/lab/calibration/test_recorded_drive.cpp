// A mission that was recorded, replayed through the estimator that drove it.

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "server/lab/slam/slam_estimators.hpp"
#include "server/lab/slam/slam_run.hpp"
#include "tests/unit/server/lab/calibration/recorded_exploration.hpp"
#include "tests/unit/server/lab/experiments/files.hpp"

namespace seeker::lab {
namespace {

class RecordedDrive : public LabFiles {};

TEST_F(RecordedDrive, ReplaysToTheTrajectoryThatTheRobotEstimatedWhileItDrove) {
  const std::vector<std::string> wheels = {"odometry_calibration.left_scale=0.99",
                                           "sim.robot.odometry.left_wheel_scale=1.0106"};
  Trajectory live;
  explore_and_record(folder() / "drive.clf.gz", 4, 200.0, wheels, [&](const app::RobotLoop& loop) {
    const PoseEstimate pose = loop.status().pose;
    if (live.empty() || to_seconds(pose.stamp) > live.back().stamp_s) {
      live.push_back({to_seconds(pose.stamp), pose.map_T_base});
    }
  });
  const auto options = app::load_robot_options(seeker::testing::source_file("config/robots/sim.yaml"), wheels).value();
  const auto tracker = make_tracker(name_of(options.estimator), options);
  ASSERT_TRUE(tracker);
  drivers::ReplayParams geometry;
  geometry.base_T_laser = options.sim.robot.lidar.base_T_laser;
  const auto run = run_slam(folder() / "drive.clf.gz", geometry, **tracker, {}, {}, options.loop.odometry_calibration);
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->log.bad, 0U);
  EXPECT_GT(length_m(live), 20.0);
  // Not the same to the last digit: returns within a centimetre of the laser's reach are read back as none.
  constexpr double kNear_m = 0.02;
  const double near_rad = deg_to_rad(0.2);
  std::size_t compared = 0;
  for (const StampedPose& replayed : run->online) {
    const std::optional<Pose2> then = pose_at(live, replayed.stamp_s);
    if (then) {
      ++compared;
      EXPECT_LT(distance_m(*then, replayed.map_T_base), kNear_m) << replayed.stamp_s;
      EXPECT_LT(std::abs(wrap_angle(then->theta_rad - replayed.map_T_base.theta_rad)), near_rad);
    }
  }
  EXPECT_GT(compared, 1500U);
}

}  // namespace
}  // namespace seeker::lab
