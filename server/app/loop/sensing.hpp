/// \file
/// What the robot's devices say: the newest readings, which of them are new, and the faults of devices that are silent
/// or that send what cannot be.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/app/estimators/odometry_history.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/loop_params.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/runtime/devices.hpp"

namespace seeker::app {

/// Owner of the readings. Lives on the loop's thread.
class Sensing {
 public:
  /// `world` and `diagnostics` outlive it.
  Sensing(const LoopParams& params, const Devices& devices, WorldLink& world, Diagnostics& diagnostics);

  /// Reads each device that is active once. A reading with numbers that cannot be is not taken.
  void read();
  /// Nothing that is there counts as new any more.
  void mark_as_used() { fresh_odometry_ = fresh_scan_ = fresh_sonar_ = false; }
  /// Silence is counted from now on: a device was started again.
  void restart_patience();
  /// The base counts anew from zero after this: odometry goes on from where it is.
  void base_restarted();

  /// The newest readings; null until there has been one.
  [[nodiscard]] const drivers::OdometrySample* odometry() const { return odometry_ ? &*odometry_ : nullptr; }
  [[nodiscard]] const LaserScan* scan() const { return scan_ ? &*scan_ : nullptr; }
  [[nodiscard]] const SonarScan* sonar() const { return sonar_ ? &*sonar_ : nullptr; }
  /// Whether the last read() brought them.
  [[nodiscard]] bool fresh_odometry() const { return fresh_odometry_; }
  [[nodiscard]] bool fresh_scan() const { return fresh_scan_; }
  [[nodiscard]] bool fresh_sonar() const { return fresh_sonar_; }

  [[nodiscard]] bool has_lidar() const { return devices_.lidar != nullptr; }
  [[nodiscard]] const OdometryHistory& history() const { return history_; }
  /// By the odometry; at rest before the first reading.
  [[nodiscard]] Twist2 velocity() const { return odometry_ ? odometry_->velocity : Twist2{}; }
  /// The base by dead reckoning; the origin before the first reading.
  [[nodiscard]] Pose2 odom_T_base() const { return odometry_ ? odometry_->odom_T_base : Pose2{}; }
  [[nodiscard]] bool moving() const;

 private:
  template <class Driver, class Sample>
  bool read(Driver* driver, const std::string& name, Duration timeout, std::optional<Sample>& latest, RobotTime& last);
  void continue_odometry(drivers::OdometrySample& sample);

  struct Timeouts {
    Duration base;
    Duration lidar;
    Duration sonar;
  };
  struct LastTimes {
    RobotTime odometry;
    RobotTime scan;
    RobotTime sonar;
  };

  Timeouts timeouts_;
  Devices devices_;
  WorldLink& world_;
  Diagnostics& diagnostics_;
  std::optional<drivers::OdometrySample> odometry_;
  std::optional<LaserScan> scan_;
  std::optional<SonarScan> sonar_;
  bool fresh_odometry_ = false;
  bool fresh_scan_ = false;
  bool fresh_sonar_ = false;
  LastTimes last_;
  OdometryHistory history_;
  std::optional<Pose2> odom_T_restart_;  ///< where the base was restarted, until its first sample after that,
  std::optional<Pose2> odom_T_counted_;  ///< and the frame in which it has counted since then
};

}  // namespace seeker::app
