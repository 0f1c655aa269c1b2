/// \file
/// Several robots explore one simulated world, each with its own loop, without knowing the starts of the others: they
/// merge their maps and divide the remaining exploration (spec S4.7, S4.10). They run in one process, on one tick
/// barrier.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/fields.hpp"
#include "server/lab/experiments/sim_run.hpp"

namespace seeker::lab {

struct FleetSpec : SimSpec {
  int robots = 2;               ///< number of robots, at the first starts of the world
  double merge_period_s = 5.0;  ///< robot time between two attempts to merge, and between announcements of a map
  bool count_traffic = false;   ///< counts FleetResult::sent_bytes, which takes time
};

struct FleetResult {
  int schema = 2;
  std::string world;
  std::uint64_t seed = 0;
  std::string settings;
  int robots = 0;
  int complete = 0;           ///< number of robots that ended with nothing left to explore
  double world_time_s = 0.0;  ///< world time until the last robot has ended
  double wall_time_s = 0.0;
  double path_length_m = 0.0;  ///< sum over all robots
  int contacts = 0;
  int robot_contacts = 0;    ///< contacts with another robot
  double waited_s = 0.0;     ///< robot time that all robots together waited for others
  double first_end_s = 0.0;  ///< when the first robot had ended
  std::string log;           ///< FleetWatch::log(), kept in a separate file
  int pairs = 0;             ///< number of pairs of robots
  int merged = 0;            ///< number of pairs that are merged at the end
  int wrong = 0;             ///< number of merges with an error above kWrongMerge_m or kWrongMerge_rad at any time
  double merged_at_s = 0.0;  ///< when the last pair was first merged; 0: none
  double error_m = 0.0;      ///< largest error of the merges at the end
  double error_deg = 0.0;
  // Where traffic is counted; not kept on disk.
  double sent_bytes = 0.0;  ///< bytes that a robot would have sent to the main one, mean
  double seen_m2 = 0.0;     ///< area of floor that a robot has observed, mean
};
void describe(config::Fields& f, FleetResult& result);

inline constexpr double kWrongMerge_m = 1.0;
inline constexpr double kWrongMerge_rad = 0.17;

/// Hash of everything that affects a run except the seed.
[[nodiscard]] Result<std::string> settings_of(const FleetSpec& spec);
/// Runs until every robot has ended. Errors: those of the files, too few starts, a refused mission.
[[nodiscard]] Result<FleetResult> run_fleet(const FleetSpec& spec);
/// Loads or makes runs, see resume_runs(); files out/runs/WORLD/fleet-N/seed-S.json and seed-S.log.
[[nodiscard]] Result<std::vector<FleetResult>> fleet_missing(const std::vector<FleetSpec>& specs,
                                                             const std::filesystem::path& out, bool show_progress);

}  // namespace seeker::lab
