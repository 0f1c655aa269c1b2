/// \file
/// Choice of the robot file that describes the scanner of a log, because CARMEN logs do not state how the laser was
/// mounted.
#pragma once

#include <filesystem>
#include <string>

#include "common/core/result.hpp"

namespace seeker::lab {

/// Name of a robot file in config/robots, chosen by the log's first scan: comma-separated numbers are from an RPLIDAR,
/// 726 beams from a URG on a Pioneer, any other scan from a scanner of 180 degrees. kNotFound, kIo; kParse where there
/// is no scan.
[[nodiscard]] Result<std::string> robot_file_for(const std::filesystem::path& log);

}  // namespace seeker::lab
