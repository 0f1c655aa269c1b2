/// \file
/// Buildings whose plan is known: a world of the simulator, or a map that was made.
#pragma once

#include "common/core/result.hpp"
#include "server/lab/scoring/score_ros_map.hpp"
#include "server/sim/world.hpp"
#include "server/tour/coverage.hpp"

namespace seeker::lab {

/// Cells of a building that was rastered.
inline constexpr double kBuildingCell_m = 0.05;

/// The world as a scanner at `height_m` sees it, with the floor that a robot of the radius can drive on from the first
/// start. Frame `world`.
[[nodiscard]] tour::KnownBuilding building_of(const sim::World& world, double robot_radius_m, double height_m);

/// The map, with the floor that the robot's centre can drive on from `start`. Frame of the map. kUnreachable: the start
/// is too near to a wall, or not on known floor.
[[nodiscard]] Result<tour::KnownBuilding> building_of(const RosMap& map, const Point2& start, double robot_radius_m);

}  // namespace seeker::lab
