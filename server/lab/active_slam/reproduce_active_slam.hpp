/// \file
/// Regenerates the figures of the active-SLAM paper in the simulator and checks its claims (spec S1.13, S7: R1).
#pragma once

#include <string>
#include <vector>

#include "server/lab/active_slam/explore_experiment.hpp"
#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/reproduce_params.hpp"

namespace seeker::lab {

/// One world of the experiment and the requirements on a map of it.
struct ExploreWorld {
  std::string name;
  std::string robot;  ///< robot file, without folder and extension
  double wall_near_m = 0.25;
  double error_limit_m = 0.20;
  double time_limit_s = 3600.0;  ///< time limit of runs that end by themselves
  std::string printed_robot;     ///< robot file of the robot as printed (spec S1.14); empty: it is not run there
};
[[nodiscard]] const std::vector<ExploreWorld>& explore_worlds();

/// Limits of the conditions.
inline constexpr double kR1WallShare = 0.95;
inline constexpr double kWallShare = 0.97;
inline constexpr double kSeedShare = 0.9;  ///< 18 of 20

/// The runs of one world, by strategy.
struct WorldRuns {
  ExploreWorld world;
  std::vector<ExploreResult> runs;
  [[nodiscard]] const ExploreResult* find(api::ExploreStrategy strategy, std::uint64_t seed) const;
};

/// Checks R1 and the further limits of an exploration, with one line for each. Conditions whose strategies were not run
/// are left out.
void check_explorations(const WorldRuns& world, Report& report);

/// The claims of Figs 4 to 7 of the paper on one robot, with one line for each. Those that the robot as printed does
/// not meet are FINDINGs.
void check_figures(const WorldRuns& world, bool printed, Report& report);

/// Makes Fig 4 (roaming map), Fig 5 (active map), Fig 6 (error over time) and Fig 7 (trace over time) of every world
/// for the first seed, and in the folder `printed` those of the robot as printed; table.csv, table.md, runs.csv; PASS,
/// FAIL and FINDING lines. Roaming never ends by itself: its time limit is the duration of the active run of the same
/// seed.
[[nodiscard]] Status reproduce_active_slam(const ReproduceParams& params, Report& report);

}  // namespace seeker::lab
