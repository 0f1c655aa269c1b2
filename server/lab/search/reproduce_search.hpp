/// \file
/// Regenerates the figures and tables of the search paper and checks them (spec S7: R5, R6, R7, R12).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/reproduce_params.hpp"
#include "server/lab/search/search_experiment.hpp"
#include "server/vision/omni_camera.hpp"

namespace seeker::lab {

/// Limits of R5.
inline constexpr double kBearingLimit_deg = 5.0;
inline constexpr double kPositionLimit_m = 0.3;
/// The robot as printed: its file in config/robots/paper, without the extension.
inline constexpr const char* kPrintedRobot = "search-2007";

/// Makes figures 3, 4 and 6 as PNG, a CSV with a row for each run, and one line for each condition in the report.
[[nodiscard]] Status reproduce_search(const ReproduceParams& params, Report& report);

/// What the paper prints of one obstacle layout (spec S3.6).
struct PrintedLayout {
  const char* world;         ///< ours that stands in for the paper's
  int cells;                 ///< the target was found in this cell
  double bearing_error_deg;  ///< of theta_0
};

/// Checks R6: eqs (4) and (5) of a camera with the printed pixels and headings.
void check_bearings(Report& report, const vision::OmniCameraParams& camera = {});
/// Checks R7: the rule base, and that the shipped FLL file equals the generated one.
void check_rules(const std::filesystem::path& config, Report& report);
/// Checks R5 for the runs of one layout by our robot; `paper_cells` is the number printed in the paper.
[[nodiscard]] Check check_layout(const std::vector<RunResult>& runs, int paper_cells);
/// Checks R5 for the runs of one layout by the robot as printed: that it finds the target, in which cell, and with
/// which error of the bearing; a line for each, with what the paper prints beside ours. Two have known causes, so that
/// they are FINDINGs where they are not met (docs/results.md): the cell depends on the room, and the heading is that of
/// the wheels alone.
[[nodiscard]] std::vector<Check> check_printed_robot(const std::vector<RunResult>& runs, const PrintedLayout& layout);
/// Checks R5's last condition: runs without a target end by themselves, with the area covered and nothing found.
[[nodiscard]] Check check_empty(const std::string& robot, const std::vector<RunResult>& runs);

}  // namespace seeker::lab
