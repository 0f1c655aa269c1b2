/// \file
/// Regenerates the tables and figures of the stereo database paper in the rendered laboratory and checks what it claims
/// (spec S2.11, S7: R3, R4).
#pragma once

#include <vector>

#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/reproduce_params.hpp"
#include "server/lab/stereo_database/stereo_result.hpp"

namespace seeker::lab {

/// Limits of the conditions.
inline constexpr double kR3ErrorRatio = 1.1;  ///< salient over all
inline constexpr double kR4ErrorRatio = 1.2;  ///< after the update over before
inline constexpr double kS2Rms_m = 0.05;
inline constexpr double kS2Rms_deg = 1.0;
inline constexpr double kS2Nees = 6.0;
inline constexpr double kS2PlaceShare = 0.95;

/// R3, R4 and the numbers that the localiser is held to, one line each, over the runs of one mode.
void check_stereo(const std::vector<StereoResult>& runs, Report& report);

/// Rows: database of each seed (spec S2.11, Table 3), and the means over the seeds.
[[nodiscard]] std::string table3_csv(const std::vector<StereoResult>& runs);
/// Figs 4, 6, 8: plan of a database with the robot's way.
[[nodiscard]] Image plan_figure(const DatabasePlan& plan, const std::vector<Point2>& way);
/// Fig 13: errors in x, y, angle, and in the plane.
[[nodiscard]] Image error_figure(const std::vector<ErrorCurve>& curves, const std::string& what);

/// Of every seed one run with our parameters, of the first seed one with the paper's. A folder a mode; Tables 1 and 2
/// and all figures of the first seed.
[[nodiscard]] Status reproduce_stereo_database(const ReproduceParams& params, Report& report);

}  // namespace seeker::lab
