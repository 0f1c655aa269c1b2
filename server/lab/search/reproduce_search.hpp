/// \file
/// Regenerates the figures and tables of the search paper and checks them (spec S7: R5, R6, R7, R12).
#pragma once

#include <filesystem>
#include <vector>

#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/reproduce_params.hpp"
#include "server/lab/search/search_experiment.hpp"

namespace seeker::lab {

/// Limits of R5.
inline constexpr double kBearingLimit_deg = 5.0;
inline constexpr double kPositionLimit_m = 0.3;

/// Makes figures 3, 4 and 6 as PNG, a CSV with a row for each run, and one line for each condition in the report.
[[nodiscard]] Status reproduce_search(const ReproduceParams& params, Report& report);

/// Checks R6: eqs (4) and (5) with the printed pixels and headings.
void check_bearings(Report& report);
/// Checks R7: the rule base, and that the shipped FLL file equals the generated one.
void check_rules(const std::filesystem::path& config, Report& report);
/// Checks R5 for the runs of one layout; `paper_cells` is the number printed in the paper.
[[nodiscard]] Check check_layout(const std::vector<RunResult>& runs, int paper_cells);

}  // namespace seeker::lab
