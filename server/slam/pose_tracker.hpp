/// \file
/// The interface of pose estimators as used by the robot loop.
#pragma once

#include "common/core/pose_estimate.hpp"
#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "common/core/time.hpp"

namespace seeker::slam {

/// Estimates the pose from odometry and scans. A failed call names the fault and leaves the estimate usable.
class PoseTracker {
 public:
  PoseTracker() = default;
  PoseTracker(const PoseTracker&) = delete;
  PoseTracker& operator=(const PoseTracker&) = delete;
  virtual ~PoseTracker() = default;

  /// Takes the newest dead reckoning. Fails with kInvalidArgument when it is not finite or time runs backwards (it is
  /// ignored), or when it jumps farther than wheels can drive (the increment is dropped, later ones count from the new
  /// pose).
  [[nodiscard]] virtual Status predict(const Pose2& odom_T_base, RobotTime stamp) = 0;
  /// Takes a scan made at the last predicted pose. Fails with kInvalidArgument when the scan is invalid or not newer
  /// than the last one (it is ignored), and with kNotReady when too few returns are left for a correction (the pose
  /// continues by odometry).
  [[nodiscard]] virtual Status update(const LaserScan& scan) = 0;
  [[nodiscard]] virtual PoseEstimate estimate() const = 0;
  /// Restarts with the robot at this pose; the next odometry becomes the origin of increments.
  virtual void reset(const Pose2& map_T_base) = 0;
};

}  // namespace seeker::slam
