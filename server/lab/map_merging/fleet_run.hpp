/// \file
/// Several robots explore one simulated world, each with a loop of its own, without knowing where the others began:
/// they lay their maps upon each other and share what is left (spec S4.7, S4.10). In one process, on one tick barrier.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/fields.hpp"
#include "server/lab/experiments/sim_run.hpp"

namespace seeker::lab {

struct FleetSpec : SimSpec {
  int robots = 2;               ///< at the first starts of the world
  double merge_period_s = 5.0;  ///< robot time between two attempts to merge, as between announcements of a map
  bool count_traffic = false;   ///< costs time; see FleetResult::sent_bytes
};

struct FleetResult {
  int schema = 2;
  std::string world;
  std::uint64_t seed = 0;
  std::string settings;
  int robots = 0;
  int complete = 0;           ///< robots that ended with nothing left to explore
  double world_time_s = 0.0;  ///< until the last robot has ended
  double wall_time_s = 0.0;
  double path_length_m = 0.0;  ///< of all
  int contacts = 0;
  int robot_contacts = 0;    ///< of them, with another robot
  double waited_s = 0.0;     ///< robot time that all together stood waiting for others
  double first_end_s = 0.0;  ///< when the first robot had ended
  std::string log;           ///< see FleetWatch::log(); in a file of its own beside this
  int pairs = 0;             ///< of robots
  int merged = 0;            ///< of them, merged at the end
  int wrong = 0;             ///< merges that were off by more than kWrongMerge_m or kWrongMerge_rad, at any time
  double merged_at_s = 0.0;  ///< the last first merge; 0: none
  double error_m = 0.0;      ///< largest, of the merges at the end
  double error_deg = 0.0;
  // Where traffic is counted; not kept on disk.
  double sent_bytes = 0.0;  ///< that each robot would have sent to the main one, mean
  double seen_m2 = 0.0;     ///< of floor that each has seen, mean
};
void describe(config::Fields& f, FleetResult& result);

inline constexpr double kWrongMerge_m = 1.0;
inline constexpr double kWrongMerge_rad = 0.17;

/// Hash of everything that shapes a run, seed excepted.
[[nodiscard]] Result<std::string> settings_of(const FleetSpec& spec);
/// Runs until every robot has ended. Errors: those of the files, too few starts, a refused mission.
[[nodiscard]] Result<FleetResult> run_fleet(const FleetSpec& spec);
/// See resume_runs(); out/runs/WORLD/fleet-N/seed-S.json, and seed-S.log.
[[nodiscard]] Result<std::vector<FleetResult>> fleet_missing(const std::vector<FleetSpec>& specs,
                                                             const std::filesystem::path& out, bool show_progress);

}  // namespace seeker::lab
