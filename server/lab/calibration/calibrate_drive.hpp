/// \file
/// Calibration of a robot from the log of a drive.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "common/core/result.hpp"
#include "server/calibration/drive_calibration.hpp"
#include "server/drivers/replay/replay.hpp"
#include "server/slam/pose_tracker.hpp"

namespace seeker::lab {

struct CalibrateDriveParams {
  calibration::DriveLegParams legs;
  calibration::DriveCalibrationParams fit;
  /// The log is read again with what was found until it changes by less than this share of its standard deviations.
  double settled_sigmas = 0.5;
  int max_passes = 5;
};

/// Makes an estimator with scan matching that has seen nothing.
using MakeTracker = std::function<std::unique_ptr<slam::PoseTracker>()>;

/// A calibration and the log that it is from.
struct CalibratedDrive {
  calibration::DriveCalibrationResult fit;
  std::uint64_t unmatched = 0;  ///< legs left out because the estimator was lost
  int passes = 0;               ///< over the log
  drivers::ReplaySummary log;
};

/// Reads the drive and calibrates from `start`. Errors of the log, and of calibration::calibrate().
[[nodiscard]] Result<CalibratedDrive> calibrate_drive(const std::filesystem::path& log,
                                                      const drivers::ReplayParams& geometry,
                                                      const MakeTracker& make_tracker,
                                                      const calibration::DriveCalibration& start,
                                                      calibration::CalibrationSubject subject,
                                                      const CalibrateDriveParams& params = {});

}  // namespace seeker::lab
