/// \file
/// Localiser knows where the robot is in which map: the estimator's pose, the map's epoch, and the trajectory in it.
#pragma once

#include <memory>
#include <optional>

#include "common/core/pose_estimate.hpp"
#include "common/core/scan.hpp"
#include "server/app/estimators/estimator.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/neighbours.hpp"
#include "server/app/loop/sensing.hpp"
#include "server/app/loop/trajectory.hpp"
#include "server/app/maps/robot_map.hpp"
#include "server/app/missions/mission_executor.hpp"

namespace seeker::app {

/// Describes how the map has changed when its epoch has risen.
struct MapShift {
  MapCorrection correction;        ///< by which missions move their places
  std::optional<Pose2> new_T_old;  ///< how the map moved around the robot; nothing: the map stays where it was
};

/// Owns estimator, map, pose and trajectory. Lives on the loop's thread.
class Localiser {
 public:
  Localiser(const LoopParams& params, const nav::OccupancyParams& occupancy, std::unique_ptr<Estimator> estimator,
            Diagnostics& diagnostics);

  /// Hands the new readings to the estimator, then takes its pose; beams that end at other robots are left out of the
  /// scan. Returns a value when the epoch has risen: the caller must pass it to all that hold places
  /// before it calls map_readings().
  [[nodiscard]] std::optional<MapShift> localise(const Sensing& sensing, const Neighbours& neighbours, RobotTime now);
  /// Writes the readings of the last localise() into the map, while the robot knows its place in it.
  void map_readings(const Sensing& sensing);
  /// Notes the pose in the trajectory.
  void note_pose(RobotTime now);

  /// The robot was found at this place; an event says so when the estimator cannot be corrected by it.
  void place_at(const PoseEstimate& place, RobotTime now);
  /// Whether the estimator wants a stereo observation now.
  [[nodiscard]] bool wants_look(RobotTime now) const { return sees_pictures_ && estimator_->wants_look(now); }
  /// A stereo picture was taken at this time; on_look() follows.
  void look_begun(RobotTime stamp) { estimator_->look_begun(stamp); }
  /// Hands a stereo observation, or why there is none, to the estimator.
  void on_look(const Result<StereoLook>& look);
  /// Puts another estimator in place of the present one; its map begins where the robot is. Call forget_places() next.
  void exchange(std::unique_ptr<Estimator> estimator, RobotTime now);
  /// Another map has come into use: clears the trajectory and takes the estimator's pose in the new map.
  void forget_places(RobotTime now);
  /// Takes the estimator's pose as it is now, after the map or the place in it were set from outside.
  void take_estimate(RobotTime now);

  [[nodiscard]] const PoseEstimate& pose() const { return pose_; }
  [[nodiscard]] RobotMap& map() { return map_; }
  [[nodiscard]] const RobotMap& map() const { return map_; }
  /// Returns the estimator's map of line segments; null when it keeps none.
  [[nodiscard]] slam::MapTracker* tracker() const { return estimator_->map_tracker(); }
  [[nodiscard]] const Trajectory& trajectory() const { return trajectory_; }

 private:
  void give_readings(const Sensing& sensing, const Neighbours& neighbours, RobotTime now);
  /// A scan that is older than the last odometry that the estimator has got, as a scanner on a slow line delivers it,
  /// seen from where that was measured: estimators take scans as made there.
  [[nodiscard]] LaserScan carried(const LaserScan& scan, const OdometryHistory& history) const;
  void give_odometry(const drivers::OdometrySample& sample);
  /// The base has moved, nobody knows how far: the robot is looked for about where its driver supposes it to be.
  void look_where_it_stood(const Pose2& odom_T_base, RobotTime now);
  [[nodiscard]] std::optional<MapShift> follow_map(const std::optional<Pose2>& old_map_T_base, RobotTime now);

  std::unique_ptr<Estimator> estimator_;
  Diagnostics& diagnostics_;
  RobotMap map_;
  Trajectory trajectory_;
  PoseEstimate pose_;
  std::optional<Pose2> odom_T_base_at_pose_;
  bool sees_pictures_;                     ///< the stereo camera feeds the estimator
  RobotTime last_odometry_given_;          ///< stamp of the last sample that the estimator got
  std::optional<RobotTime> exchanged_at_;  ///< when the present estimator took over; nothing: it was the first
  std::optional<LaserScan>
      without_movers_;  ///< the newest scan without beams that end at other robots, where there are any
};

}  // namespace seeker::app
