/// \file
/// What a simulated building offers to a map of walls. Truth: for scoring only.
#pragma once

#include <optional>
#include <vector>

#include "common/core/polygon.hpp"
#include "common/core/pose2.hpp"
#include "server/sim/robot_model.hpp"
#include "server/sim/scene.hpp"
#include "server/sim/world.hpp"

namespace seeker::lab {

struct TrueWallParams {
  double piece_m = 0.1;      ///< walls are judged in pieces of this length
  double view_step_m = 0.3;  ///< raster of the places that walls are looked at from
  double shortest_m = 0.3;   ///< a stretch that is not seen from one place over this length holds no line
};

/// One side of a short piece of wall.
struct WallPiece {
  Point2 p_world = Point2::Zero();  ///< its middle
  Point2 normal = Point2::UnitX();  ///< towards the side it is seen from
  double length_m = 0.0;
};

/// In the frame `world`, at the height of the lidar.
struct TrueWalls {
  std::vector<WallPiece> reachable;     ///< walls of the building that the robot can see from floor it can reach
  std::vector<sim::Segment> walls;      ///< all of them, seen or not
  std::vector<sim::Segment> furniture;  ///< faces of everything else, targets too; what is solid lies to the left
  [[nodiscard]] double reachable_m() const;
};

/// Reachable is the floor connected to the first start for the robot's radius, inside `bound_world` where given. Seen
/// is what lies within the lidar's range, unhidden and not under a grazing angle.
[[nodiscard]] TrueWalls true_walls(const sim::World& world, const sim::RobotModel& robot,
                                   const std::optional<Polygon>& bound_world, const TrueWallParams& params = {});

}  // namespace seeker::lab
