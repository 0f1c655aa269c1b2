/// \file
/// What several node pairs say together of how two maps lie to each other. A pair tells what its place can tell: along
/// a bare corridor it knows nothing, and has no say there.
#pragma once

#include <vector>

#include "common/core/pose2.hpp"

namespace seeker::fleet {

/// One pair in the frames of both maps: a local map of robot b, and where the pair puts it.
struct PairPlace {
  UncertainPose map_a_T_node;  ///< by the pair
  Pose2 map_b_T_node;          ///< in b's own map
};

/// The place of a pair from what it says of its two local maps, and where those lie in the maps of their robots.
[[nodiscard]] PairPlace pair_place(const UncertainPose& node_a_T_node_b, const Pose2& map_a_T_node_a,
                                   const Pose2& map_b_T_node_b);

/// How far maps may be bent beside what their covariances say.
struct BendParams {
  double sigma_m = 0.05;       ///< between two local maps near each other,
  double sigma_rad = 0.02;     ///< and their headings
  double whole_sigma_m = 0.5;  ///< of a local map to where the whole map as a rigid body puts it,
  double whole_sigma_rad = 0.05;
};

/// The pose of map b in map a that all pairs together say, as if both maps were rigid: least squares weighted by the
/// pairs' covariances and the bend between neighbours (Gauss-Newton, with (x, y, theta) in the frame of map a as
/// unknowns). `pairs` is not empty. Covariance: of that estimate.
[[nodiscard]] UncertainPose fuse(const std::vector<PairPlace>& pairs, const BendParams& params);

/// Where a local map of b lies in map a: where the rigid `whole` puts it, corrected by the pair nearest to it as far as
/// that one knows better (maps bend).
[[nodiscard]] Pose2 carried(const std::vector<PairPlace>& pairs, const Pose2& whole, const Pose2& map_b_T_node,
                            const BendParams& params);

}  // namespace seeker::fleet
