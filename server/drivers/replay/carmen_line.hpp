/// \file
/// One line of a CARMEN log as a value. The functions have no state.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"

namespace seeker::drivers {

/// `ODOM x y theta tv rv accel ipc_stamp host logger_stamp`
struct CarmenOdometry {
  double stamp_s = 0.0;  ///< on the log's own clock
  Pose2 odom_T_base;
  Twist2 velocity;
};

/// `FLASER n r.. x y theta ox oy otheta ipc_stamp host logger_stamp`, or the newer `RAWLASER1` / `ROBOTLASER1`.
struct CarmenScan {
  double stamp_s = 0.0;
  std::vector<float> ranges_m;          ///< as logged, with codes for "none"; 0 for nan, infinity for inf
  std::vector<float> strengths;         ///< signal quality or remission, one per range; empty: not logged
  std::optional<double> angle_min_rad;  ///< stated by RAWLASER1 and ROBOTLASER1 only
  std::optional<double> angle_step_rad;
  std::optional<double> range_max_m;  ///< stated likewise, or by PARAM: a reading of this range is no echo
  std::optional<Pose2> odom_T_base;   ///< raw odometry at the scan (second triplet); not in RAWLASER1
  std::optional<Pose2>
      corrected_T_laser;  ///< first triplet: a mapper's result; for scoring only, no driver passes it on
  std::string host;       ///< the word between the two stamps; in some logs it states the accuracy of the stamp
};

using CarmenRecord = std::variant<CarmenOdometry, CarmenScan>;

[[nodiscard]] double stamp_of(const CarmenRecord& record);

/// Range of the front laser, where the line is a PARAM that states it (`laser_front_laser_max_range`, or the configured
/// limit of the robot, `robot_front_laser_max`).
[[nodiscard]] std::optional<double> stated_range_max_m(std::string_view line);

/// Parses one line without its line end. Nothing: an empty line, a comment, PARAM, or a message type not used here.
/// kParse: malformed or cut off; kTooLarge: more beams than kMaxScanBeams.
[[nodiscard]] Result<std::optional<CarmenRecord>> parse_carmen_line(std::string_view line);

}  // namespace seeker::drivers
