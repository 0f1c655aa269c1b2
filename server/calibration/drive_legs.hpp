/// \file
/// Cuts a drive into legs, each with the motion that the wheels and the motion that the laser measured.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/scan.hpp"
#include "common/core/wheel_calibration.hpp"
#include "server/slam/pose_tracker.hpp"

namespace seeker::calibration {

/// What is calibrated of a robot: its wheels, and the place of its laser.
struct DriveCalibration {
  WheelCalibration wheels;
  Pose2 base_T_laser;

  friend bool operator==(const DriveCalibration&, const DriveCalibration&) = default;
};

/// One leg of a drive, measured twice.
struct DriveLeg {
  std::vector<Pose2> increments;  ///< motions by uncorrected odometry, one after the other, as base_T_next
  UncertainPose from_T_to;        ///< motion of the laser by its scans, in the frame of the laser at the start
};

struct DriveLegParams {
  double length_m = 0.5;  ///< a leg ends after this path; a turn on the spot is part of a leg
  /// A leg ends where the robot rotates no faster: stamps of scans and odometry that are apart by a part of a second
  /// cost degrees otherwise.
  double end_rotation_rad_s = 0.1;
  double longest_m = 8.0;     ///< a leg of a robot that never stops rotating ends after this path
  double longest_rad = 12.0;  ///< or after this sum of rotations
  double sigma_m = 0.006;     ///< error of the laser's motion
  double sigma_rad = 0.003;
};

/// Makes legs from odometry and scans. The motion of the laser is that of a tracker with scan matching, which keeps to
/// its map: errors of single matches do not add up from leg to leg. The tracker's own odometry is corrected and its
/// scans are mounted as predicted; what is wrong in the prediction it follows a little, so that a drive is read again
/// with the calibration that was found.
class DriveLegs {
 public:
  /// `tracker` begins with the first reading and must outlive this.
  DriveLegs(slam::PoseTracker& tracker, const DriveLegParams& params, const DriveCalibration& predicted);

  /// Takes the newest odometry, uncorrected. Stamps rise.
  void add(const Pose2& odom_T_base, RobotTime stamp);
  /// Takes a scan made at the last odometry; the mount that it states is not used. One that the tracker refuses ends no
  /// leg.
  void add(const LaserScan& scan);

  [[nodiscard]] const std::vector<DriveLeg>& legs() const { return legs_; }
  /// Number of legs that were left out because the tracker was lost, or its map changed.
  [[nodiscard]] std::uint64_t unmatched() const { return unmatched_; }

 private:
  void begin(const PoseEstimate& estimate);
  [[nodiscard]] bool leg_is_complete() const;
  void end_leg(const PoseEstimate& estimate);

  slam::PoseTracker& tracker_;
  DriveLegParams params_;
  DriveCalibration predicted_;
  std::optional<Pose2> measured_T_base_;
  RobotTime stamp_;
  Pose2 odom_T_base_;                  ///< corrected
  double rotation_rad_s_ = 0.0;        ///< by the last two odometries
  std::optional<PoseEstimate> first_;  ///< at the start of the leg that is being driven
  std::vector<Pose2> increments_;      ///< of that leg
  double path_m_ = 0.0;                ///< of that leg
  double rotated_rad_ = 0.0;           ///< sum of the rotations on that leg, of either sign
  std::vector<DriveLeg> legs_;
  std::uint64_t unmatched_ = 0;
};

}  // namespace seeker::calibration
