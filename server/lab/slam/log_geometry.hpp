/// \file
/// Which robot file states the scanner of a log: CARMEN logs do not say how the laser was mounted.
#pragma once

#include <filesystem>
#include <string>

#include "common/core/result.hpp"

namespace seeker::lab {

/// Name of a robot file in config/robots, chosen by the log's first scan: numbers with commas are an RPLIDAR, 726
/// beams a URG on a Pioneer, anything else a scanner of 180 degrees. kNotFound, kIo; kParse where there is no scan.
[[nodiscard]] Result<std::string> robot_file_for(const std::filesystem::path& log);

}  // namespace seeker::lab
