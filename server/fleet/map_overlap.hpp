/// \file
/// Overlap of two aligned maps: the length of wall that both have observed, and the share of the common area in which
/// one contradicts the other.
#pragma once

#include <functional>
#include <optional>

#include "server/fleet/prepared_map.hpp"
#include "server/slam/scan_matcher.hpp"

namespace seeker::fleet {

struct OverlapParams {
  double cell_m = 0.15;            ///< size of the cells by which walls are counted
  double partner_m = 0.15;         ///< largest distance between a wall of one map and its partner in the other
  double min_normal_cosine = 0.7;  ///< smallest cosine of the angle between their normals
  double piece_gap_m = 0.3;        ///< largest gap between cells of one piece of contradicted wall
  double witness_wall_m = 6.0;     ///< wall shared by a local map alone for it to count as a witness
  /// Largest correction of a single node before it is compared, since maps are distorted.
  double settle_m = 0.3;
  double settle_rad = 0.05;
  slam::MatchParams match;
  slam::AgreementParams agreement;
  std::size_t match_points = 300;
};

struct MapOverlap {
  double shared_wall_m = 0.0;  ///< length of wall that both have observed
  double weak_wall_m = 0.0;    ///< part of it that constrains the least constrained direction: short in a corridor
  /// Share (0 to 1) of walls that the other has looked through and of beams through its walls. Walls that b itself has
  /// looked through do not count as walls of b: robots and people that stood there for a while.
  double contradiction = 0.0;
  /// Length of the longest piece of wall of b that a has looked through, counted by cells of OverlapParams::cell_m.
  double denied_piece_m = 0.0;
  double residual_m = 0.0;  ///< root mean square distance of the shared walls
  /// Number of local maps of b that share OverlapParams::witness_wall_m with a, each aligned alone.
  std::size_t witnesses = 0;
};

/// Compares the nodes of b with a. `map_a_T_node` gives the pose of a node of b, by index, in the frame `map` of a; one
/// whose pose is not known well enough has none, and proves and denies nothing. The opposite direction has a result of
/// its own: a may contradict an observation of b and not vice versa.
[[nodiscard]] MapOverlap overlap_of(PreparedMap& a, PreparedMap& b,
                                    const std::function<std::optional<Pose2>(std::size_t)>& map_a_T_node,
                                    const OverlapParams& params = {});

}  // namespace seeker::fleet
