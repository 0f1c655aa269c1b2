/// \file
/// Rearranged furniture: the changes that a robot meets when it returns later.
#pragma once

#include <cstddef>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "common/core/rng.hpp"
#include "server/sim/world.hpp"

namespace seeker::sim {

/// Moves this share of the objects (at least one), each as a whole and with unchanged appearance: an object on the
/// floor is placed on another free place with another heading, an object on a wall slides along it. The starts stay
/// free, and the robot can still reach nearly all of the floor. Returns how many were moved, which are fewer where
/// there is no room. kInvalidArgument: the world is invalid or the share is outside 0..1. kUnreachable: no object can
/// be moved.
[[nodiscard]] Result<std::size_t> move_objects(World& world, double share, Rng& rng);

/// Makes another room of the same kind: bounds, walls, starts and the places of all objects are scaled by the factors,
/// and the objects keep their sizes. Asserts factors above 0. The caller must validate the world, because objects that
/// stood close together may overlap now.
void stretch(World& world, const Point2& factors);

}  // namespace seeker::sim
