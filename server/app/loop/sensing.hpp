/// \file
/// Sensing keeps the newest readings of the devices, knows which of them are new, and raises faults for devices that
/// are silent or send what is impossible.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/app/estimators/odometry_history.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/loop_params.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/runtime/devices.hpp"
#include "server/drivers/interfaces/odometry_calibrator.hpp"

namespace seeker::app {

/// Owns the readings. Lives on the loop's thread.
class Sensing {
 public:
  /// `world` and `diagnostics` must outlive it.
  Sensing(const LoopParams& params, const Devices& devices, WorldLink& world, Diagnostics& diagnostics);

  /// Reads each device that is active once. A reading with impossible numbers is rejected and raises a fault, as does
  /// what a device says is wrong with it.
  void read();
  /// Marks all readings as used: none counts as new any more.
  void mark_as_used() { fresh_odometry_ = fresh_scan_ = fresh_sonar_ = false; }
  /// Counts the newest readings as new once more, for an estimator that has seen none of them.
  void mark_as_new();
  /// Drops the readings of a device that was deactivated: they would only grow older.
  void forget(const std::string& name);
  /// Uses other time-outs from now on.
  void use(const LoopParams& params) { timeouts_ = {params.base_timeout, params.lidar_timeout, params.sonar_timeout}; }
  /// Counts silence from now on; call it when devices were started.
  void restart_patience();
  /// Call it after the base was restarted and counts from zero: odometry goes on from the pose that it had.
  void base_restarted();

  /// These return the newest readings; null until there has been one.
  [[nodiscard]] const drivers::OdometrySample* odometry() const { return odometry_ ? &*odometry_ : nullptr; }
  [[nodiscard]] const LaserScan* scan() const { return scan_ ? &*scan_ : nullptr; }
  [[nodiscard]] const SonarScan* sonar() const { return sonar_ ? &*sonar_ : nullptr; }
  /// These return what the last read() brought; null when it brought nothing new.
  [[nodiscard]] const drivers::OdometrySample* new_odometry() const { return fresh_odometry_ ? odometry() : nullptr; }
  [[nodiscard]] const LaserScan* new_scan() const { return fresh_scan_ ? scan() : nullptr; }
  [[nodiscard]] const SonarScan* new_sonar() const { return fresh_sonar_ ? sonar() : nullptr; }
  /// Returns the new odometry as the base measured it, without the calibration of its wheels; null as above.
  [[nodiscard]] const drivers::OdometrySample* new_measured_odometry() const {
    return fresh_odometry_ ? &*measured_odometry_ : nullptr;
  }

  /// Which sensors feed which parts of the robot.
  [[nodiscard]] const Connections& connections() const { return connections_; }
  /// These return what feeds a part with those inputs; null until there has been one, and where nothing does.
  [[nodiscard]] const LaserScan* scan_for(const RangeInputs& inputs) const { return inputs.scan ? scan() : nullptr; }
  [[nodiscard]] const SonarScan* sonar_for(const RangeInputs& inputs) const {
    return inputs.echoes ? sonar() : nullptr;
  }
  /// True when the map is written from scans of the lidar, false for the echoes of the sonar ring.
  [[nodiscard]] bool maps_by_lidar() const {
    return devices_.lidar != nullptr && connections_.map.ranges == RangeSensor::kLidar;
  }
  [[nodiscard]] const OdometryHistory& history() const { return history_; }
  /// Returns the velocity by odometry; at rest before the first reading.
  [[nodiscard]] Twist2 velocity() const { return odometry_ ? odometry_->velocity : Twist2{}; }
  /// Returns the pose of the base by dead reckoning; the origin before the first reading.
  [[nodiscard]] Pose2 odom_T_base() const { return odometry_ ? odometry_->odom_T_base : Pose2{}; }
  [[nodiscard]] bool moving() const;
  /// False while the base cannot say how it moves: scans taken meanwhile lie nobody knows where.
  [[nodiscard]] bool motion_known() const;

 private:
  template <class Driver, class Sample>
  bool read(Driver* driver, const std::string& name, const char* port, Duration timeout, std::optional<Sample>& latest,
            RobotTime& last);
  void continue_odometry(drivers::OdometrySample& sample);
  /// Raises what is wrong with a device, and clears what no longer is.
  void note_faults(const drivers::Driver* driver, const std::string& name);
  /// Takes the motion of the base out of a scan that took its time; without odometry the scan stays as it is.
  void correct_for_motion(LaserScan& scan) const;

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
  Connections connections_;
  Devices devices_;
  WorldLink& world_;
  Diagnostics& diagnostics_;
  std::optional<drivers::OdometrySample> measured_odometry_;  ///< as it came in, on through restarts of the base
  drivers::OdometryCalibrator calibrator_;
  std::optional<drivers::OdometrySample> odometry_;
  std::optional<LaserScan> scan_;
  std::optional<SonarScan> sonar_;
  bool fresh_odometry_ = false;
  bool fresh_scan_ = false;
  bool fresh_sonar_ = false;
  LastTimes last_;
  std::map<std::string, std::set<std::string>> device_faults_;  ///< raised ones, by the device's name
  OdometryHistory history_;
  std::optional<Pose2> odom_T_restart_;  ///< where the base was restarted, until its next sample; as measured
  std::optional<Pose2> odom_T_counted_;  ///< the frame in which the base has counted since its restart
};

}  // namespace seeker::app
