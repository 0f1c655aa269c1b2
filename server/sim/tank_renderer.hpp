/// \file
/// Pictures of a camera over the floor of a tank of turbid water: solids, floor and walls, by casting a ray through
/// every pixel and one more to the lamp.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/core/image.hpp"
#include "common/core/rng.hpp"
#include "server/sim/turbid_water.hpp"

namespace seeker::sim {

/// Where the picture is taken from; the floor is z = 0, the camera has no roll.
struct TankEye {
  Eigen::Vector3d position = Eigen::Vector3d::UnitZ();
  double heading_rad = 0.0;
  double tilt_rad = 0.0;  ///< of the optical axis, down from the horizon
  double off_u_px = 0.0;  ///< of the optical axis from the picture's middle
  double off_v_px = 0.0;
};

/// How far the walls are from below the eye, in directions relative to its heading that ascend evenly. Painted like the
/// floor. Empty: no walls.
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
/// What it covers of the floor at most, counter-clockwise.
[[nodiscard]] std::vector<Point2> outline(const TankSolid& solid);

}  // namespace seeker::sim
