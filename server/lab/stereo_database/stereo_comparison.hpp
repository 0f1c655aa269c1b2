/// \file
/// The stereo database paper row by row: what the robot as printed shows beside what ours does (spec S7: R3, R4).
#pragma once

#include <vector>

#include "server/lab/experiments/check.hpp"
#include "server/lab/stereo_database/stereo_bisection.hpp"
#include "server/lab/stereo_database/stereo_result.hpp"

namespace seeker::lab {

/// A row for each table and figure, with the means over the seeds. PASS: both robots meet its condition; FINDING: only
/// ours does; FAIL: ours does not. Tables 1 to 3 and Figs 1, 4, 6, 7, 8, 12, 13 are of R3. R4 is left out where no run
/// as printed has updated its database.
void compare_stereo(const std::vector<StereoResult>& printed, const std::vector<StereoResult>& ours, Report& report);

/// One row of all bisections: the error of the robot as printed, with each choice in turn as ours, and with all of them
/// as ours. It names the choice that lowers the error most, and passes where ours errs less than the printed robot.
void report_bisection(const std::vector<BisectionResult>& bisections, Report& report);

}  // namespace seeker::lab
