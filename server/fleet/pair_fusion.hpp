/// \file
/// Fusion of node pairs into the relative pose of two maps. Each pair contributes by its covariance: along a bare
/// corridor it holds no information.
#pragma once

#include <vector>

#include "common/core/pose2.hpp"

namespace seeker::fleet {

/// One pair in the frames of both maps: the pose of a local map of robot b according to the pair.
struct PairPlace {
  UncertainPose map_a_T_node;  ///< according to the pair
  Pose2 map_b_T_node;          ///< in b's own map
};

/// The place of a pair, from the relation of its two local maps and their poses in the maps of their robots.
[[nodiscard]] PairPlace pair_place(const UncertainPose& node_a_T_node_b, const Pose2& map_a_T_node_a,
                                   const Pose2& map_b_T_node_b);

/// Distortion of maps beyond their covariances.
struct DistortionParams {
  double sigma_m = 0.05;          ///< relative displacement of neighbouring local maps
  double sigma_rad = 0.02;        ///< relative rotation of neighbouring local maps
  double whole_sigma_m = 0.5;     ///< displacement of a local map from its pose in the rigid map
  double whole_sigma_rad = 0.05;  ///< rotation of a local map from that pose
};

/// The pose of map b in map a by all pairs, as if both maps were rigid: least squares weighted by the pairs'
/// covariances and the distortion between neighbours (Gauss-Newton, with (x, y, theta) in the frame of map a as
/// unknowns), with the covariance of that estimate. `pairs` must not be empty.
[[nodiscard]] UncertainPose fuse(const std::vector<PairPlace>& pairs, const DistortionParams& params);

/// The pose of a local map of b in map a: by the rigid pose `whole`, corrected by the nearest pair as far as that one
/// is more certain, since maps are distorted.
[[nodiscard]] Pose2 carried(const std::vector<PairPlace>& pairs, const Pose2& whole, const Pose2& map_b_T_node,
                            const DistortionParams& params);

}  // namespace seeker::fleet
