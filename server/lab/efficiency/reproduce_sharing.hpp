/// \file
/// What several robots gain that share an exploration by tours: time and path against one robot.
#pragma once

#include <string>
#include <vector>

#include "server/lab/active_slam/explore_result.hpp"
#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/reproduce_params.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/map_merging/fleet_run.hpp"

namespace seeker::lab {

/// One world of the experiment.
struct SharingWorld {
  std::string name;
  std::string robot;    ///< robot file, without folder and extension
  int most_robots = 2;  ///< at the first starts of the world
};
[[nodiscard]] const std::vector<SharingWorld>& sharing_worlds();

/// The largest share of one robot's time that two robots may take in the mean of many runs, and in a few, which
/// scatter.
inline constexpr double kTwoRobotsShare = 0.60;
inline constexpr double kTwoRobotsShareOfFew = 0.80;
inline constexpr std::size_t kManyRuns = 10;

/// All runs of one world.
struct SharingRuns {
  SharingWorld world;
  std::vector<ExploreResult> alone;
  std::vector<std::vector<FleetResult>> fleets;  ///< of two robots, of three, and so on
};

/// One row for each world and number of robots: means and spreads, and the share of one robot's mean time.
[[nodiscard]] Table sharing_table(const std::vector<SharingRuns>& worlds);

/// Time of two robots against one, wrong merges and contacts; a line for each.
void check_sharing(const SharingRuns& world, Report& report);

/// Runs one robot and fleets of up to SharingWorld::most_robots that know nothing of each other's starts; table.csv and
/// table.md as of sharing_table(); PASS and FAIL lines.
[[nodiscard]] Status reproduce_sharing(const ReproduceParams& params, Report& report);

}  // namespace seeker::lab
