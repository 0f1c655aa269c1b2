// Drives in a toy world whose ways are blocked for a while, or for good.

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "server/nav/retry_drive.hpp"
#include "server/nav/sonar_obstacles.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/toy_world.hpp"

namespace seeker::nav {
namespace {

using seeker::testing::box;
using seeker::testing::Point2Near;
using seeker::testing::ToyBase;
using seeker::testing::ToyWorld;
using seeker::testing::Wall;

constexpr double kTick_s = 0.1;

/// A robot that has seen the whole of its world and drives in it.
class Driven : public ToyBase {
 public:
  Driven(const ToyWorld& world, const Pose2& start, const DriverParams& params, const RetryParams& retry = {})
      : ToyBase(world, start, 3), drive_(params, retry) {
    for (double x = 0.5; x < end_of(world); x += 4.0) {
      look_from({x, start.y_m, 0.0});
      look_from({x, start.y_m, kPi});
    }
  }

  /// Where the drive had to end, and when.
  struct Run {
    DriveState state = DriveState::kDriving;
    std::string reason;
    double seconds = 0.0;
  };
  Run run(const Point2& goal, double limit_s, const std::function<void(double t_s, Driven& robot)>& hook = nullptr) {
    drive_.go(goal, robot_time_s(0.0));
    Run out;
    for (int tick = 0; tick * kTick_s < limit_s && out.state == DriveState::kDriving; ++tick) {
      out.seconds = tick * kTick_s;
      if (hook) {
        hook(out.seconds, *this);
      }
      const RobotTime now = robot_time_s(out.seconds);
      const LaserScan laser_scan = laser(now);
      const SonarScan sonar_scan = sonar(now);
      (void)map_.integrate(laser_scan, pose_);
      floors_.attend(map_, pose_, now);
      const DriveInput input{now, pose_, &sonar_scan, &laser_scan, floors_};
      obstacles_.note(input);
      const DriveStep step = drive_.step(input);
      out.state = step.state;
      out.reason = step.reason;
      if (!held) {
        drive(step.command);
      }
    }
    return out;
  }

  bool held = false;  ///< the base does not move, whatever it is told

 private:
  static double end_of(const ToyWorld& world) {
    double end = 0.0;
    for (const Wall& wall : world.walls) {
      end = std::max({end, wall.first.x(), wall.second.x()});
    }
    return end;
  }
  void look_from(const Pose2& pose) {
    const Pose2 present = std::exchange(pose_, pose);
    for (int k = 0; k < 3; ++k) {
      (void)map_.integrate(laser({}), pose_);
    }
    pose_ = present;
  }

  OccupancyMap map_;
  FloorSource floors_{{}, {}, 0.2, 1.0};
  SonarObstacles obstacles_;
  RetryDrive drive_;
};

ToyWorld corridor(double length_m, double width_m) {
  ToyWorld world;
  world.walls = box(0.0, -width_m / 2.0, length_m, width_m / 2.0);
  return world;
}

/// Two rooms whose only door, 0.9 m wide, is at x = 4 m.
ToyWorld rooms_with_a_door() {
  ToyWorld world;
  world.walls = box(0.0, -2.0, 8.0, 2.0);
  world.walls.push_back({{4.0, -2.0}, {4.0, -0.45}});
  world.walls.push_back({{4.0, 0.45}, {4.0, 2.0}});
  return world;
}

/// Somebody steps before the robot as it comes to `at_x_m`, and stands there for so long.
class Passer {
 public:
  Passer(double at_x_m, double stays_s) : at_x_m_(at_x_m), stays_s_(stays_s) {}
  void operator()(double t_s, Driven& robot) {
    constexpr double kAhead_m = 0.75;
    if (!came_s_ && robot.pose().x_m > at_x_m_ - kAhead_m) {
      came_s_ = t_s;
      walls_ = robot.world().walls.size();
      for (const Wall& wall : box(at_x_m_, -0.2, at_x_m_ + 0.3, 0.2)) {
        robot.world().walls.push_back(wall);
      }
    }
    if (came_s_ && walls_ && t_s > *came_s_ + stays_s_) {
      robot.world().walls.resize(*walls_);
      walls_.reset();
    }
  }

 private:
  double at_x_m_;
  double stays_s_;
  std::optional<double> came_s_;
  std::optional<std::size_t> walls_;
};

TEST(RetryDrive, WhoLeavesTheOnlyDoorIsNotRemembered) {
  Driven robot(rooms_with_a_door(), {1.0, 0.0, 0.0}, {});
  const Driven::Run run = robot.run({7.0, 0.0}, 200.0, Passer(4.0, 3.0));
  EXPECT_EQ(run.state, DriveState::kArrived) << run.reason << " after " << run.seconds << " s";
  EXPECT_LT(run.seconds, 50.0) << "one wait is enough";
}

TEST(RetryDrive, WhoStaysInTheOnlyDoorEndsItAfterEveryAttempt) {
  Driven robot(rooms_with_a_door(), {1.0, 0.0, 0.0}, {});
  const Driven::Run run = robot.run({7.0, 0.0}, 400.0, Passer(4.0, 1e6));
  EXPECT_EQ(run.state, DriveState::kFailed);
  EXPECT_FALSE(run.reason.empty());
  EXPECT_GT(run.seconds, 45.0);
  EXPECT_LT(run.seconds, 150.0);
}

TEST(RetryDrive, EncountersFarApartAreEachForgivenAsTheRobotGetsNearer) {
  Passer first(4.0, 3.0);
  Passer second(9.0, 3.0);
  Passer third(14.0, 3.0);
  Driven robot(corridor(20.0, 1.0), {1.0, 0.0, 0.0}, {}, {.attempts = 2, .retry_s = 5.0});
  const Driven::Run run = robot.run({18.0, 0.0}, 300.0, [&](double t_s, Driven& there) {
    first(t_s, there);
    second(t_s, there);
    third(t_s, there);
  });
  EXPECT_EQ(run.state, DriveState::kArrived) << run.reason << " after " << run.seconds << " s";
}

TEST(RetryDrive, ALongWayMayTakeLongAsLongAsTheRobotGetsNearer) {
  DriverParams params;
  params.goal_time_s = 10.0;
  Driven robot(corridor(30.0, 2.0), {1.0, 0.0, 0.0}, params, {.attempts = 1, .retry_s = 15.0});
  const Driven::Run run = robot.run({29.0, 0.0}, 200.0);
  EXPECT_EQ(run.state, DriveState::kArrived) << run.reason;
  EXPECT_GT(run.seconds, 5.0 * params.goal_time_s);
}

TEST(RetryDrive, ABaseThatDoesNotMoveEndsItThoughTheWayIsPlannedAnewAllTheTime) {
  DriverParams params;
  params.replan_period_s = 2.0;
  Driven robot(corridor(10.0, 2.0), {1.0, 0.0, 0.0}, params);
  robot.held = true;
  const Driven::Run run = robot.run({8.0, 0.0}, 400.0);
  EXPECT_EQ(run.state, DriveState::kFailed);
  EXPECT_LT(run.seconds, 200.0);
}

TEST(RetryDrive, WhatOnlySonarsSeeIsDrivenRound) {
  ToyWorld world = corridor(10.0, 3.0);
  world.low_things = box(4.0, -0.3, 4.4, 0.3);
  DriverParams params;
  params.replan_period_s = 2.0;
  Driven robot(world, {1.0, 0.0, 0.0}, params);
  const Driven::Run run = robot.run({8.0, 0.0}, 120.0, [](double, Driven& there) {
    EXPECT_GT(there.world().clearance(there.pose().translation()), 0.2);
  });
  EXPECT_EQ(run.state, DriveState::kArrived) << run.reason;
  EXPECT_THAT(robot.pose().translation(), Point2Near(Point2(8.0, 0.0), 0.15));
}

}  // namespace
}  // namespace seeker::nav
