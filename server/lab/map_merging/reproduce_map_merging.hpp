/// \file
/// Regenerates the figures of the map merging paper in the simulator and checks its claims (spec S4.10, S7: R8, R9).
#pragma once

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

/// Load of one second of robot time, and the additional load of features of that second's picture. The check uses the
/// counts of features; processor times are for the figure, because they depend on other load of the machine.
struct LoadSample {
  double time_s = 0.0;
  double loop_s = 0.0;      ///< processor time of the robot's loop with its simulator
  double features_s = 0.0;  ///< processor time of the features of one picture of the omnidirectional camera
  int features = 0;         ///< number of features
  /// Whether a node was made in this second: with the keyframe principle only then features are extracted.
  bool node = false;

  [[nodiscard]] double frame_s() const { return loop_s + features_s; }
  [[nodiscard]] int keyframe_features() const { return node ? features : 0; }
  [[nodiscard]] double keyframe_s() const { return loop_s + (node ? features_s : 0.0); }
};
/// Fig 11: load over time, with features of every frame and with features of nodes only.
[[nodiscard]] Image load_figure(const std::vector<LoadSample>& samples);

/// Checks that every direction of the tree's sections is passable in the scan and that every goal lies in a section.
[[nodiscard]] Check check_tree(const LaserScan& scan, const fleet::SpaceTree& tree,
                               const fleet::SpaceTreeParams& params);
/// Checks explorations of one robot: they end complete, without contact, and map the walls.
[[nodiscard]] Check check_single(const std::vector<ExploreResult>& runs);
/// Checks R9: with keyframes fewer features are extracted than with frames, all of them at nodes and at every node. The
/// mean processor times and the number of their peaks at nodes are reported but not judged.
[[nodiscard]] Check check_keyframes(const std::vector<LoadSample>& samples);

/// Checks R8: two robots that do not know each other's start merge their maps with small errors, and never wrongly.
[[nodiscard]] Check check_merges(const std::vector<FleetResult>& runs);
/// Checks that two robots at the ends of two equal corridors are never merged wrongly, however long their observations
/// agree.
[[nodiscard]] Check check_trap(const std::vector<FleetResult>& runs);
/// Checks that several robots need less time than one, with runs of the same seeds.
[[nodiscard]] Check check_sharing(const std::vector<FleetResult>& runs, const std::vector<ExploreResult>& single);

/// Limits of the conditions.
inline constexpr double kMergeShare = 0.95;  ///< 19 of 20
inline constexpr double kMergeError_m = 0.2;
inline constexpr double kMergeError_deg = 2.0;
inline constexpr double kSharedTime = 0.65;
inline constexpr double kArenaWallShare = 0.90;

/// Makes Fig 3 (tree), Fig 6 (map of one robot with its nodes), Fig 11 (load), the merges of two robots (of Fig 10a);
/// runs.csv, table.csv, fleet.csv, trap.csv; PASS and FAIL lines.
[[nodiscard]] Status reproduce_map_merging(const ReproduceParams& params, Report& report);

}  // namespace seeker::lab
