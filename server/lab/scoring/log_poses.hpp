/// \file
/// The poses that a recorded log holds: the odometry, which estimators may use, and a mapper's poses, which are for
/// scoring.
#pragma once

#include <filesystem>
#include <vector>

#include "common/core/result.hpp"
#include "server/drivers/replay/carmen_reader.hpp"
#include "server/lab/scoring/trajectory.hpp"

namespace seeker::lab {

struct LogPoses {
  Trajectory odometry;   ///< odometry at the scans, or of the odometry records where scans carry none
  Trajectory corrected;  ///< poses of the laser at the scans by a mapper, where the log has them
  std::vector<double> scan_stamps_s;
  std::vector<double> exact_stamps_s;  ///< stamps of the scans whose host field is `exact`
  drivers::ReplaySummary summary;
};

/// Reads a log, plain or .gz. kNotFound, kIo; kParse when it holds no record. Records out of order count as bad.
[[nodiscard]] Result<LogPoses> read_log_poses(const std::filesystem::path& path);

}  // namespace seeker::lab
