/// \file
/// Furniture that is not where it was: what a robot finds when it comes back later.
#pragma once

#include <cstddef>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/rng.hpp"
#include "server/sim/world.hpp"

namespace seeker::sim {

/// Moves this share of the objects (at least one), each as a whole and each looking as before: what stands on the floor
/// goes to another free place with another heading, what hangs on a wall slides along it. The starts stay free, and the
/// robot still reaches nearly all of the floor. Returns how many were moved: fewer where there is no room.
/// kInvalidArgument: an invalid world, a share outside 0..1; kUnreachable: nothing can be moved.
[[nodiscard]] Result<std::size_t> move_objects(World& world, double share, Rng& rng);

/// Another room of the same kind: bounds, walls, starts and the places of all things go with the factors, the things
/// keep their sizes. Asserts factors above 0. The caller validates: things that stood close together may overlap now.
void stretch(World& world, const Point2& factors);

}  // namespace seeker::sim
