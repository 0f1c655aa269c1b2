/// \file
/// The true walls of a simulated building that a map can hold. They are for scoring only.
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
  double piece_m = 0.1;      ///< walls are divided into pieces of this length
  double view_step_m = 0.3;  ///< step of the raster of viewpoints
  double shortest_m = 0.3;   ///< a part of a wall that is not observed from one place over this length gives no line
};

/// One side of a short piece of wall.
struct WallPiece {
  Point2 p_world = Point2::Zero();  ///< middle of the piece
  Point2 normal = Point2::UnitX();  ///< towards the side that it is seen from
  double length_m = 0.0;
};

/// Walls in the frame `world`, at the height of the lidar.
struct TrueWalls {
  std::vector<WallPiece> reachable;  ///< walls of the building that the robot can observe from floor that it can reach
  std::vector<sim::Segment> walls;   ///< all walls, whether observed or not
  /// Faces of all other objects, targets included; their solid side is on the left.
  std::vector<sim::Segment> furniture;
  [[nodiscard]] double reachable_m() const;
};

/// Computes the true walls. Reachable is the floor connected to the first start for the robot's radius, inside
/// `bound_world` where given. Observed is what lies within the lidar's range, not hidden and not at a grazing angle.
[[nodiscard]] TrueWalls true_walls(const sim::World& world, const sim::RobotModel& robot,
                                   const std::optional<Polygon>& bound_world, const TrueWallParams& params = {});

}  // namespace seeker::lab
