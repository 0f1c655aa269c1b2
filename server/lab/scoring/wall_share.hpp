/// \file
/// Share of a building's walls that a map of segments holds, and length of mapped walls that do not exist.
#pragma once

#include <optional>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/line_map.hpp"
#include "server/lab/scoring/true_walls.hpp"

namespace seeker::lab {

struct WallShareParams {
  double near_m = 0.25;  ///< a piece of wall is mapped when a mapped segment lies within this distance of it ...
  double parallel_rad = deg_to_rad(2.0);  ///< ... is parallel to it within this angle, and is seen from the same side
  double sample_m = 0.05;                 ///< distance of the points at which false walls are measured
};

struct WallShare {
  double reachable_m = 0.0;  ///< length of walls that can be mapped
  double mapped_m = 0.0;     ///< length of these that is mapped
  double map_m = 0.0;        ///< length of all segments of the map
  double false_m = 0.0;      ///< length of the map's segments farther than near_m from all solid objects
  bool aligned = false;      ///< false: too little in common for an alignment, the guess was used
  Pose2 world_T_map;
  std::vector<WallPiece> missing;  ///< reachable pieces that are not mapped

  [[nodiscard]] double share() const { return reachable_m > 0.0 ? mapped_m / reachable_m : 0.0; }
};

/// The rigid motion that aligns the segments best with the true walls, searched from `guess` (within about a metre).
/// Nothing: too few segments fit.
[[nodiscard]] std::optional<Pose2> align_walls(const std::vector<MapSegment>& segments, const TrueWalls& walls,
                                               const Pose2& guess);

/// The shares after that rigid motion.
[[nodiscard]] WallShare share_of_walls(const std::vector<MapSegment>& segments, const TrueWalls& walls,
                                       const Pose2& guess_world_T_map, const WallShareParams& params = {});

}  // namespace seeker::lab
