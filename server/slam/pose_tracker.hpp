/// \file
/// What the robot loop asks of a pose estimator, whichever it is.
#pragma once

#include "common/core/pose_estimate.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"

namespace seeker::slam {

/// Odometry and scans in, pose out. A failed call names the fault and leaves the estimate usable.
class PoseTracker {
 public:
  PoseTracker() = default;
  PoseTracker(const PoseTracker&) = delete;
  PoseTracker& operator=(const PoseTracker&) = delete;
  virtual ~PoseTracker() = default;

  /// Takes the newest dead reckoning. kInvalidArgument: not finite or time running backwards (ignored), or a jump that
  /// no wheel makes (the increment is dropped, later ones count from the new place).
  [[nodiscard]] virtual Status predict(const Pose2& odom_T_base, RobotTime stamp) = 0;
  /// Takes a scan made at the last predicted pose. kInvalidArgument: not a scan, or not newer than the last one
  /// (ignored). kNotReady: too few returns to say anything; the pose goes on by odometry.
  [[nodiscard]] virtual Status update(const LaserScan& scan) = 0;
  [[nodiscard]] virtual PoseEstimate estimate() const = 0;
  /// Starts anew with the robot at this pose; the next odometry becomes the origin of increments.
  virtual void reset(const Pose2& map_T_base) = 0;
};

}  // namespace seeker::slam
