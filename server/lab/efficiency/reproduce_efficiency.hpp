/// \file
/// How far from the possible the strategies of exploration drive: path and time against what somebody would drive who
/// knows the building.
#pragma once

#include <string>
#include <vector>

#include "server/lab/active_slam/explore_result.hpp"
#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/reproduce_params.hpp"
#include "server/lab/experiments/table.hpp"

namespace seeker::lab {

/// One world of the experiment.
struct EfficiencyWorld {
  std::string name;
  std::string robot;  ///< robot file, without folder and extension
  double time_limit_s = 7200.0;
  /// Largest share of the path and of the time of `frontier` that `tour` may take on the same seeds; 0: not checked.
  double path_share = 0.0;
  double time_share = 0.0;

  /// Whether the world is one of those with limits.
  [[nodiscard]] bool judged() const { return path_share > 0.0 || time_share > 0.0; }
};
[[nodiscard]] const std::vector<EfficiencyWorld>& efficiency_worlds();

/// What a map must hold for a short path to count.
inline constexpr double kEfficientWallShare = 0.97;
inline constexpr double kEfficientError_m = 0.02;

/// All runs of one world, and the yardstick.
struct EfficiencyRuns {
  EfficiencyWorld world;
  double open_tour_m = 0.0;  ///< path of somebody who knows the building
  double floor_m2 = 0.0;     ///< floor that can be seen
  std::vector<ExploreResult> runs;
};

/// One row for each world and strategy: means and spreads, and the ratio of the mean path to the yardstick
/// (*competitive ratio*).
[[nodiscard]] Table efficiency_table(const std::vector<EfficiencyRuns>& worlds);

/// Path, time, walls, floor and errors of `tour` against `frontier`, and the contacts of all; a line for each. A
/// condition without runs of its strategies is left out.
void check_efficiency(const EfficiencyRuns& world, Report& report);

/// Runs tour, horizon, frontier, gain and active in every world; table.csv and table.md as of efficiency_table(),
/// runs.csv, and for every world a picture of the yardstick and curves of the
/// floor known over the path for the first seed; PASS and FAIL lines.
[[nodiscard]] Status reproduce_efficiency(const ReproduceParams& params, Report& report);

}  // namespace seeker::lab
