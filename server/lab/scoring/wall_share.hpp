/// \file
/// How much of a building's walls a map of segments holds, and how much it holds that is not there.
#pragma once

#include <optional>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/line_map.hpp"
#include "server/lab/scoring/true_walls.hpp"

namespace seeker::lab {

struct WallShareParams {
  double near_m = 0.25;                   ///< a piece of wall counts when a mapped segment is so near to it ...
  double parallel_rad = deg_to_rad(2.0);  ///< ... runs along it to within this, and is seen from the same side
  double sample_m = 0.05;                 ///< false walls are measured at points this far apart
};

struct WallShare {
  double reachable_m = 0.0;  ///< wall length there is to map
  double mapped_m = 0.0;     ///< of it, mapped
  double map_m = 0.0;        ///< length of all segments of the map
  double false_m = 0.0;      ///< of it, farther than near_m from everything solid
  bool aligned = false;      ///< false: too little in common to align, the guess was used
  Pose2 world_T_map;
  std::vector<WallPiece> missing;  ///< reachable pieces that are not mapped

  [[nodiscard]] double share() const { return reachable_m > 0.0 ? mapped_m / reachable_m : 0.0; }
};

/// The rigid motion that lays the segments best on what is there, found from `guess` (to within about a metre); nothing
/// when too little fits.
[[nodiscard]] std::optional<Pose2> align_walls(const std::vector<MapSegment>& segments, const TrueWalls& walls,
                                               const Pose2& guess);

/// After that one rigid motion.
[[nodiscard]] WallShare share_of_walls(const std::vector<MapSegment>& segments, const TrueWalls& walls,
                                       const Pose2& guess_world_T_map, const WallShareParams& params = {});

}  // namespace seeker::lab
