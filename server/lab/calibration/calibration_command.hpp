/// \file
/// Commands `seeker-lab odometry-calibrate` and `seeker-lab extrinsics`.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "server/calibration/drive_calibration.hpp"

namespace seeker::lab {

struct CalibrationOptions {
  std::filesystem::path log;
  std::filesystem::path out;    ///< file for the section of the robot file; empty: none is written
  std::filesystem::path robot;  ///< robot file, or the name of one in `config`/robots; empty: chosen by the log
  std::filesystem::path config;
  std::string estimator;  ///< that shows where the laser was; empty: the one of the robot file
  std::vector<std::string> overrides;
  bool json = false;
};

/// Calibrates from the robot file's values, prints what was found to `out` and writes the section. Errors of the files,
/// and kNotReady where the drive does not show what is asked for; kInvalidArgument for an estimator
/// without scan matching.
[[nodiscard]] Status run_calibration(const CalibrationOptions& options, calibration::CalibrationSubject subject,
                                     std::ostream& out);

}  // namespace seeker::lab
