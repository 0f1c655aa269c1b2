/// \file
/// Takes the systematic errors of the wheels out of odometry while it comes in.
#pragma once

#include <optional>

#include "common/core/wheel_calibration.hpp"
#include "server/drivers/interfaces/drivers.hpp"

namespace seeker::drivers {

/// Corrects the motion from sample to sample and adds it up again, from the first sample's pose.
class OdometryCalibrator {
 public:
  explicit OdometryCalibrator(const WheelCalibration& calibration = {}) : calibration_(calibration) {}

  /// The sample with pose and velocity corrected; the very same sample where there is nothing to correct.
  [[nodiscard]] OdometrySample apply(const OdometrySample& measured);

 private:
  WheelCalibration calibration_;
  std::optional<Pose2> measured_T_base_;  ///< of the last sample, as it came in
  Pose2 odom_T_base_;                     ///< of the last sample, corrected
};

}  // namespace seeker::drivers
