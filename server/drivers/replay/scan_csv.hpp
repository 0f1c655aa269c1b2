/// \file
/// One line of a comma-separated scanner log: `t,odom_x,odom_y,odom_theta,r0,r1,...`. A range may carry the signal
/// quality of its beam behind a colon, as in `2.31:47`. The functions have no state.
#pragma once

#include <optional>
#include <string_view>

#include "common/core/result.hpp"
#include "server/drivers/replay/carmen_line.hpp"

namespace seeker::drivers {

/// Whether the line consists of comma-separated numbers, as no CARMEN record does.
[[nodiscard]] bool is_scan_csv(std::string_view line);

/// Parses one line. `inf`, `nan` and an empty field mean a beam without return (range 0). kParse: malformed, cut off or
/// without a range, or with the quality of some of the ranges only; kTooLarge: more beams than kMaxScanBeams.
[[nodiscard]] Result<CarmenScan> parse_scan_csv_line(std::string_view line);

/// Parses a line of either kind of log, which it recognises by the content; otherwise as parse_carmen_line().
[[nodiscard]] Result<std::optional<CarmenRecord>> parse_log_line(std::string_view line);

}  // namespace seeker::drivers
