/// \file
/// Regenerates the figures of the map merging paper in the simulator and checks what it claims (spec S4.10, S7: R8,
/// R9).
#pragma once

#include <vector>

#include "common/core/image.hpp"
#include "server/fleet/space_tree.hpp"
#include "server/lab/active_slam/explore_run.hpp"
#include "server/lab/experiments/check.hpp"
#include "server/lab/experiments/reproduce_params.hpp"
#include "server/lab/map_merging/fleet_run.hpp"

namespace seeker::lab {

/// Fig 3: the scan, the layers' sections, the possible goals and the main goal; frame of the base.
[[nodiscard]] Image tree_figure(const LaserScan& scan, const fleet::SpaceTree& tree,
                                const fleet::SpaceTreeParams& params);

/// The work of one second of robot time, and what features of that second's picture would add. What is judged is
/// counted (features); processor times are for the figure, since they depend on what else the machine does.
struct LoadSample {
  double time_s = 0.0;
  double loop_s = 0.0;      ///< the robot's loop with its simulator
  double features_s = 0.0;  ///< processor time of the features of one picture of the omnidirectional camera
  int features = 0;         ///< how many there are
  bool node = false;        ///< a node was made in this second: the keyframe principle takes its picture only then

  [[nodiscard]] double frame_s() const { return loop_s + features_s; }
  [[nodiscard]] int keyframe_features() const { return node ? features : 0; }
  [[nodiscard]] double keyframe_s() const { return loop_s + (node ? features_s : 0.0); }
};
/// Fig 11: load over time with features of every frame and of nodes only.
[[nodiscard]] Image load_figure(const std::vector<LoadSample>& samples);

/// Every direction of the tree's sections is passable in the scan, and every goal lies in a section.
[[nodiscard]] Check check_tree(const LaserScan& scan, const fleet::SpaceTree& tree,
                               const fleet::SpaceTreeParams& params);
/// Explorations of one robot: they end complete, without contact, and map the walls.
[[nodiscard]] Check check_single(const std::vector<ExploreResult>& runs);
/// R9: with keyframes fewer features are extracted than with frames, all of them at nodes and at every node. The mean
/// processor times and how many of their peaks are at nodes stand beside, and are not judged.
[[nodiscard]] Check check_keyframes(const std::vector<LoadSample>& samples);

/// R8: two robots that do not know where the other began merge their maps, near the truth, and never wrongly.
[[nodiscard]] Check check_merges(const std::vector<FleetResult>& runs);
/// Two robots at the ends of two corridors that are alike are never merged wrongly, however long they see the same.
[[nodiscard]] Check check_trap(const std::vector<FleetResult>& runs);
/// Several robots need less time than one; runs of the same seeds.
[[nodiscard]] Check check_sharing(const std::vector<FleetResult>& runs, const std::vector<ExploreResult>& single);

/// Limits of the conditions.
inline constexpr double kMergeShare = 0.95;  ///< 19 of 20
inline constexpr double kMergeError_m = 0.2;
inline constexpr double kMergeError_deg = 2.0;
inline constexpr double kSharedTime = 0.65;
inline constexpr double kArenaWallShare = 0.90;

/// Fig 3 (tree), Fig 6 (map of one robot with its nodes), Fig 11 (load), the merges of two robots (of Fig 10a);
/// runs.csv, table.csv, fleet.csv, trap.csv; PASS and FAIL lines.
[[nodiscard]] Status reproduce_map_merging(const ReproduceParams& params, Report& report);

}  // namespace seeker::lab
