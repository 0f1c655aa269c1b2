/// \file
/// Several robots explore one simulated world, each with its own loop, without knowing the starts of the others: they
/// merge their maps and divide the remaining exploration (spec S4.7, S4.10). They run in one process, on one tick
/// barrier.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/api/mission.hpp"
#include "common/config/fields.hpp"
#include "common/core/line_map.hpp"
#include "common/core/topology.hpp"
#include "server/lab/experiments/sim_run.hpp"

namespace seeker::lab {

struct FleetSpec : SimSpec {
  api::ExploreStrategy strategy = api::ExploreStrategy::kTopological;
  int robots = 2;               ///< number of robots, at the first starts of the world
  double merge_period_s = 5.0;  ///< robot time between two attempts to merge, and between announcements of a map
  bool count_traffic = false;   ///< counts FleetResult::sent_bytes, which takes time
  std::string label;            ///< of the folder of the results: which kind of robot it is; empty: ours
  /// The second robot has a picture of the first one's start at its own start, so that a false pair of nodes is
  /// proposed as soon as both have a map (spec S7, R8).
  bool inject_false_pair = false;
};

/// What Fig 10(a) shows of one robot, in its own frame `map`.
struct FleetDrawing {
  std::string id;
  Pose2 main_T_map;
  std::vector<MapSegment> segments;
  std::vector<Pose2> path;
  Topology topology;
};

struct FleetResult {
  int schema = 4;
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
  int pictures = 0;        ///< pictures taken at nodes, by all robots
  int alike = 0;           ///< places of either robot whose pictures confirm the merges at the end, least pair
  int injected = 0;        ///< comparisons of two maps to which a false pair of nodes was added
  int false_rejected = 0;  ///< comparisons in which the false pair was refused
  int false_offered = 0;   ///< comparisons in which it was left as a hypothesis, believed or not
  int false_accepted = 0;  ///< comparisons in which the maps were merged by it
  std::vector<FleetDrawing> drawings;  ///< of the first robot and those that are merged with it; not kept on disk
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
/// Loads or makes runs, see resume_runs(); files out/runs/WORLD/fleet-N/seed-S.json, seed-S.log and
/// seed-S.png (Fig 10(a)); fleet-N-LABEL where the spec has a label.
[[nodiscard]] Result<std::vector<FleetResult>> fleet_missing(const std::vector<FleetSpec>& specs,
                                                             const std::filesystem::path& out, bool show_progress);

}  // namespace seeker::lab
