/// \file
/// Pictures of a camera over the floor of a tank of turbid water: solids, floor and walls, with one ray through every
/// pixel and one more to the lamp.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/core/image.hpp"
#include "common/core/rng.hpp"
#include "server/sim/turbid_water.hpp"

namespace seeker::sim {

/// Pose of the camera; the floor is z = 0, and the camera has no roll.
struct TankEye {
  Eigen::Vector3d position = Eigen::Vector3d::UnitZ();
  double heading_rad = 0.0;
  double tilt_rad = 0.0;  ///< angle of the optical axis down from the horizon
  double off_u_px = 0.0;  ///< offset of the optical axis from the picture's middle
  double off_v_px = 0.0;
};

/// Distances of the walls from the point below the eye, in evenly spaced ascending directions relative to its heading.
/// The walls are painted like the floor. Empty: there are no walls.
struct TankWalls {
  double first_rad = 0.0;
  double step_rad = 0.0;
  std::vector<double> distance_m;
};

/// Grey picture of kTankWidth_px x kTankHeight_px.
[[nodiscard]] Image render_tank(const std::vector<TankSolid>& solids, const TankEye& eye, const TankWalls& walls,
                                const TurbidWater& water, Rng& rng);

/// Height of a solid's middle over the floor.
[[nodiscard]] double half_height_m(const TankSolid& solid);
/// Outline of the largest area of the floor that the solid covers, counter-clockwise.
[[nodiscard]] std::vector<Point2> outline(const TankSolid& solid);

}  // namespace seeker::sim
