/// \file
/// Seeded placement of targets and starts, for experiments over many seeds.
#pragma once

#include <cstddef>

#include "common/core/grid.hpp"
#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/rng.hpp"
#include "server/sim/world.hpp"

namespace seeker::sim {

struct PlacementParams {
  double robot_radius_m = 0.30;     ///< the robot must be able to come near with this much room
  double robot_height_m = 0.65;     ///< furniture above it is no obstacle
  double target_clearance_m = 0.5;  ///< smallest distance from the target's centre to any other object
  double target_to_start_m = 2.0;   ///< at least this far from the start
  double start_clearance_m = 0.45;  ///< smallest distance from the robot's centre to any object
  double resolution_m = 0.1;        ///< resolution of the raster from which places are drawn
};

/// Moves target `index` to a random place with a random heading that the robot can come near to from the first start,
/// and returns the new pose. kUnreachable: there is no such place. A poster (depth 0) is refused, because it needs a
/// wall.
[[nodiscard]] Result<Pose2> place_target(World& world, std::size_t index, Rng& rng, const PlacementParams& params = {});

/// Replaces the starts by one random pose on the floor that is connected to the first of them, and returns it.
[[nodiscard]] Result<Pose2> place_start(World& world, Rng& rng, const PlacementParams& params = {});

/// A raster over the world: clearance in metres (at most 1) of every cell that the centre of a robot of this radius can
/// reach from the first start, -1 elsewhere. The start's own cell is always reached.
[[nodiscard]] Grid<float> reachable_floor(const World& world, double robot_radius_m, double resolution_m = 0.05,
                                          double robot_height_m = 0.65);

/// Area of the floor that the centre of a robot of this radius can reach from the first start.
[[nodiscard]] double reachable_area_m2(const World& world, double robot_radius_m, double resolution_m = 0.05);

}  // namespace seeker::sim
