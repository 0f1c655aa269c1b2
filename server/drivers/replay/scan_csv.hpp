/// \file
/// One line of a scanner log with commas: `t,odom_x,odom_y,odom_theta,r0,r1,...`. Pure text in, value out.
#pragma once

#include <optional>
#include <string_view>

#include "common/core/result.hpp"
#include "server/drivers/replay/carmen_line.hpp"

namespace seeker::drivers {

/// True for a line of numbers with commas between them: no CARMEN record looks like that.
[[nodiscard]] bool is_scan_csv(std::string_view line);

/// Parses one line. `inf`, `nan` and an empty field mean that nothing came back (range 0). kParse: malformed, cut off
/// or without a range; kTooLarge: more beams than kMaxScanBeams.
[[nodiscard]] Result<CarmenScan> parse_scan_csv_line(std::string_view line);

/// A line of a log of either kind, told apart by its content; otherwise as parse_carmen_line().
[[nodiscard]] Result<std::optional<CarmenRecord>> parse_log_line(std::string_view line);

}  // namespace seeker::drivers
