/// \file
/// Lines of a CARMEN log out of values, as parse_carmen_line() reads them. Numbers are written with as many digits as
/// it takes to read the same value back. The functions have no state.
#pragma once

#include <string>

#include "common/core/scan.hpp"
#include "server/drivers/replay/carmen_line.hpp"

namespace seeker::drivers {

/// The two stamps that end each line.
struct LogStamp {
  double stamp_s = 0.0;        ///< when the reading was made, on the log's own clock; written in microseconds
  double since_start_s = 0.0;  ///< the same since the recording began
};

/// The range that is written for a beam without return where the scanner states no largest range.
inline constexpr double kCarmenNoReturn_m = 81.83;

/// First lines of a log: what it is, and the mount of the laser, which robot files state for a replay.
[[nodiscard]] std::string carmen_header(const std::string& robot_id);
[[nodiscard]] std::string carmen_mount_comment(const Pose2& base_T_laser);

/// `ODOM` with its line end. The stamp of `odometry` is not used.
[[nodiscard]] std::string carmen_odometry_line(const CarmenOdometry& odometry, const LogStamp& stamp);

/// `ROBOTLASER1` with its line end: a scan that was made all at once while the base was at `odom_T_base`. A beam
/// without return is written as range_max_m and an unusable one as 0, so that returns within a centimetre of
/// range_max_m are read back as none. Signal quality is written as remission.
[[nodiscard]] std::string carmen_scan_line(const LaserScan& scan, const Pose2& odom_T_base, const Twist2& velocity,
                                           const LogStamp& stamp);

}  // namespace seeker::drivers
