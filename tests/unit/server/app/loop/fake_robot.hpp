/// \file
/// Devices without a world: tests say what they measure and whether they answer.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "server/app/estimators/estimator.hpp"
#include "server/app/runtime/devices.hpp"

namespace seeker::app::testing {

/// Robot time that moves when a test says so, and a link that may be lost.
class HandClock final : public drivers::Clock {
 public:
  RobotTime now() const override { return time; }
  Status advance(Duration period) override {
    time += period;
    return {};
  }
  Status reachable() const override { return link; }
  bool lockstep() const override { return true; }
  double speed() const override { return run_speed; }

  RobotTime time{std::chrono::seconds(100)};
  Status link;
  double run_speed = 0.0;
};

/// Hands out each reading once; an error until it is taken away.
template <class Base, class Sample>
class FakeSensor : public Base {
 public:
  Status activate() override { return {}; }
  void deactivate() override {}
  Result<std::optional<Sample>> read() override {
    if (!ok) {
      return tl::unexpected<Error>(ok.error());
    }
    return std::exchange(next, std::nullopt);
  }

  std::optional<Sample> next;
  Status ok;
};

using FakeLidar = FakeSensor<drivers::LidarDriver, LaserScan>;
using FakeSonar = FakeSensor<drivers::SonarDriver, SonarScan>;

/// Remembers what it was commanded.
class FakeBase final : public FakeSensor<drivers::BaseDriver, drivers::OdometrySample> {
 public:
  Status set_velocity(const Twist2& velocity, RobotTime /*now*/) override {
    commanded.push_back(velocity);
    return accepts;
  }
  Status set_motors(bool enabled) override {
    motors = enabled;
    return accepts;
  }

  std::vector<Twist2> commanded;
  bool motors = false;
  Status accepts;
};

/// Is where a test says.
class FakeEstimator final : public Estimator {
 public:
  Status on_odometry(const drivers::OdometrySample& sample) override {
    odometry.push_back(sample.stamp);
    return odometry_ok;
  }
  Status on_scan(const LaserScan& scan) override {
    scans.push_back(scan);
    return {};
  }
  PoseEstimate estimate() const override { return pose; }

  std::vector<RobotTime> odometry;
  std::vector<LaserScan> scans;
  Status odometry_ok;
  PoseEstimate pose;
};

inline drivers::OdometrySample odometry_at(RobotTime stamp, const Pose2& odom_T_base, const Twist2& velocity = {}) {
  drivers::OdometrySample sample;
  sample.stamp = stamp;
  sample.odom_T_base = odom_T_base;
  sample.velocity = velocity;
  return sample;
}

/// A sweep over the half circle before the robot, all beams of one range.
inline LaserScan sweep_at(RobotTime stamp, float range_m) {
  LaserScan scan;
  scan.stamp = stamp;
  scan.angle_min_rad = -1.5;
  scan.angle_step_rad = 0.1;
  scan.range_min_m = 0.05;
  scan.range_max_m = 8.0;
  scan.ranges_m.assign(31, range_m);
  return scan;
}

}  // namespace seeker::app::testing
