/// \file
/// How far lines depend on the initial thresholds: the paper's detector against split-and-merge, on many scenes and on
/// a recorded log (spec S5.4, R10).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "common/core/scan.hpp"
#include "server/lab/experiments/check.hpp"

namespace seeker::lab {

/// One scan of a scanner like the RPLIDAR in a furnished room; both are drawn from the seed.
[[nodiscard]] LaserScan scene_scan(std::uint64_t seed);

/// Every `step`-th scan of a recorded log. Errors of the log.
[[nodiscard]] Result<std::vector<LaserScan>> scans_of_log(const std::filesystem::path& log,
                                                          const std::filesystem::path& robot_file, std::size_t step);

/// Extracts the lines of each scan with initial thresholds from half to twice the printed ones. A line that the printed
/// thresholds give is kept where another factor gives one within 5 mm and 0.5 degrees. Adds a condition for the
/// detector as printed, and one for ours, whose limits follow the noise: fewer lines are lost than by split-and-merge
/// with the same factors. Returns the table as CSV.
[[nodiscard]] std::string check_sensitivity(const std::string& name, const std::vector<LaserScan>& scans,
                                            Report& report);

}  // namespace seeker::lab
