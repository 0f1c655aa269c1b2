/// \file
/// Output of `seeker-lab odometry-calibrate` and `seeker-lab extrinsics`.
#pragma once

#include <filesystem>
#include <string>

#include "server/lab/calibration/calibrate_drive.hpp"

namespace seeker::lab {

/// The section of a robot file that states what was found, after a comment that says from where.
[[nodiscard]] std::string calibration_yaml(const std::filesystem::path& log, const CalibratedDrive& drive,
                                           calibration::CalibrationSubject subject);
/// Figures for people, and the section.
[[nodiscard]] std::string calibration_text(const std::filesystem::path& log, const CalibratedDrive& drive,
                                           calibration::CalibrationSubject subject);
[[nodiscard]] std::string calibration_json(const std::filesystem::path& log, const CalibratedDrive& drive,
                                           calibration::CalibrationSubject subject);

}  // namespace seeker::lab
