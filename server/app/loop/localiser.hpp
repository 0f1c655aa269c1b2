/// \file
/// Where the robot is in which map: the estimator's pose, the map's epoch, and the trajectory in it.
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

/// What has changed when the map's epoch has risen.
struct MapShift {
  MapCorrection correction;        ///< what missions move their places by
  std::optional<Pose2> new_T_old;  ///< how the map moved around the robot; nothing: the map stays where it was
};

/// Owner of estimator, map, pose and trajectory. Lives on the loop's thread.
class Localiser {
 public:
  Localiser(const LoopParams& params, const nav::OccupancyParams& occupancy, std::unique_ptr<Estimator> estimator,
            Diagnostics& diagnostics);

  /// Hands the new readings to the estimator, then takes its pose; beams that end at other robots are left out of the
  /// scan. Something, where the map has moved: everything that holds places follows it, before map_readings().
  [[nodiscard]] std::optional<MapShift> localise(const Sensing& sensing, const Neighbours& neighbours, RobotTime now);
  /// Writes the same readings into the map, where the robot is known to be in it.
  void map_readings(const Sensing& sensing);
  /// Notes the pose in the trajectory.
  void note_pose(RobotTime now);

  /// The robot was found at this place; an estimator that cannot be corrected so is told in an event.
  void place_at(const PoseEstimate& place, RobotTime now);
  [[nodiscard]] bool wants_look(RobotTime now) const { return estimator_->wants_look(now); }
  void look_begun(RobotTime stamp) { estimator_->look_begun(stamp); }
  void on_look(const Result<StereoLook>& look);
  /// Another map is in use: the trajectory is void, and the pose is the estimator's in the new one.
  void forget_places(RobotTime now);
  /// Takes the estimator's pose as it is now, after the map or the place in it were set from outside.
  void take_estimate(RobotTime now);

  [[nodiscard]] const PoseEstimate& pose() const { return pose_; }
  [[nodiscard]] RobotMap& map() { return map_; }
  [[nodiscard]] const RobotMap& map() const { return map_; }
  /// The keeper of the map of segments; null where the estimator keeps none.
  [[nodiscard]] slam::MapTracker* tracker() const { return estimator_->map_tracker(); }
  [[nodiscard]] const Trajectory& trajectory() const { return trajectory_; }

 private:
  void give_readings(const Sensing& sensing, const Neighbours& neighbours, RobotTime now);
  void give_odometry(const drivers::OdometrySample& sample);
  [[nodiscard]] std::optional<MapShift> follow_map(const std::optional<Pose2>& old_map_T_base, RobotTime now);

  std::unique_ptr<Estimator> estimator_;
  Diagnostics& diagnostics_;
  RobotMap map_;
  Trajectory trajectory_;
  PoseEstimate pose_;
  std::optional<Pose2> odom_T_base_at_pose_;
  RobotTime last_odometry_given_;  ///< stamp of the last sample that the estimator got
  std::optional<LaserScan>
      without_movers_;  ///< the newest scan without beams that end at other robots, where there are any
};

}  // namespace seeker::app
