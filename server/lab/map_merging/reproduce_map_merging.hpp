/// \file
/// Regenerates the figures of the map merging paper in the simulator and checks its claims (spec S4.10, S7: R8, R9).
#pragma once

#include <string>
#include <vector>

#include "common/core/image.hpp"
#include "server/fleet/space_tree.hpp"
#include "server/lab/active_slam/explore_run.hpp"
#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/reproduce_params.hpp"
#include "server/lab/map_merging/fleet_run.hpp"

namespace seeker::lab {

/// Fig 3: the scan, the sections of the layers, the possible goals and the main goal, in the frame `base`.
[[nodiscard]] Image tree_figure(const LaserScan& scan, const fleet::SpaceTree& tree,
                                const fleet::SpaceTreeParams& params);

/// What one second of robot time of a running robot cost. The check uses the counts; processor times are for the
/// figure, because they depend on other load of the machine.
struct LoadSample {
  double time_s = 0.0;
  /// Processor time of the robot's loop with its simulator, but without the rendering of pictures, which stands for the
  /// camera.
  double cpu_s = 0.0;
  int pictures = 0;   ///< pictures whose features were extracted
  int features = 0;   ///< features of all of them
  bool node = false;  ///< whether a node was made in this second
};
/// Fig 11: load over time of a run with features of every frame and of one with features of nodes only.
[[nodiscard]] Image load_figure(const std::vector<LoadSample>& keyframe, const std::vector<LoadSample>& frame);
/// Fig 10(a): the walls, paths and nodes of all robots in the map of the first one; robots that are not merged are left
/// out.
[[nodiscard]] Image merged_figure(const FleetResult& run);

/// Checks that every direction of the tree's sections is passable in the scan and that every goal lies in a section.
[[nodiscard]] Check check_tree(const LaserScan& scan, const fleet::SpaceTree& tree,
                               const fleet::SpaceTreeParams& params);
/// Checks explorations of one robot: they end complete, without contact, and map the walls.
[[nodiscard]] Check check_single(const std::vector<ExploreResult>& runs);
/// Checks R9 on two runs of one seed over the time that both lasted: with keyframes fewer features are extracted than
/// with frames, all of them in seconds with a node, and a picture is taken at every node. The mean processor times and
/// the number of their peaks at nodes are reported but not judged.
[[nodiscard]] Check check_keyframes(std::vector<LoadSample> keyframe, std::vector<LoadSample> frame);

/// Checks R8: two robots that do not know each other's start merge their maps with small errors, and never wrongly.
[[nodiscard]] Check check_merges(const std::vector<FleetResult>& runs);
/// The same of robots as printed (config/robots/paper/merging-2013.yaml): where they miss the condition, it is a
/// finding.
[[nodiscard]] Check check_printed_merges(const std::vector<FleetResult>& runs);
/// Checks R8 where a false pair of nodes was injected: it is refused, and no merge comes of it.
[[nodiscard]] Check check_false_pairs(const std::vector<FleetResult>& runs);
/// The same of robots as printed: what they accept is a finding.
[[nodiscard]] Check check_printed_false_pairs(const std::vector<FleetResult>& runs);
/// Checks that pictures raise the share of right merges within kPosterTime_s of robot time where the laser sees equal
/// places and the camera different posters, and that none is wrong. Where the laser alone merges all of them in time
/// and pictures spoil nothing, it is a finding: there is nothing to raise.
[[nodiscard]] Check check_posters(const std::string& id, const std::vector<FleetResult>& pictures,
                                  const std::vector<FleetResult>& laser);
/// Checks that two robots at the ends of two equal corridors are never merged wrongly, however long their observations
/// agree.
[[nodiscard]] Check check_trap(const std::vector<FleetResult>& runs);
/// Checks that several robots need less time than one, with runs of the same seeds.
[[nodiscard]] Check check_sharing(const std::vector<FleetResult>& runs, const std::vector<ExploreResult>& single);

/// Limits of the conditions.
inline constexpr double kMergeShare = 0.95;  ///< 19 of 20
inline constexpr double kMergeError_m = 0.2;
inline constexpr double kMergeError_deg = 2.0;
inline constexpr double kSharedTime = 0.65;  ///< of the mean of kSharedRuns at least
inline constexpr std::size_t kSharedRuns = 10;
/// Single runs scatter from 0.52 to 0.78.
inline constexpr double kSharedTimeOfFew = 0.80;
inline constexpr double kArenaWallShare = 0.90;
inline constexpr double kPosterTime_s = 300.0;

/// The parts of the experiment, named after their worlds, each of which may be run alone (ReproduceParams::worlds).
[[nodiscard]] std::vector<std::string> map_merging_worlds();

/// Makes Fig 3 (tree), Fig 6 (map of one robot with its nodes), Fig 10(a) (merged maps), Fig 11 (load); runs.csv,
/// table.csv, fleet.csv with the rows of the robots as printed and of ours, trap.csv, twin-posters.csv, half-turn.csv,
/// others.csv (pairs of different buildings);
/// PASS, FAIL and FINDING lines.
[[nodiscard]] Status reproduce_map_merging(const ReproduceParams& params, Report& report);

}  // namespace seeker::lab
