/// \file
/// A world of line segments and a noisy laser in it, for the tests of this folder.
#pragma once

#include <cmath>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "common/core/scan.hpp"
#include "tests/support/toy_world.hpp"

namespace seeker::slam {

using testing::box;
using testing::Wall;

/// A room of 10 x 6 m with a cupboard and a pillar.
inline std::vector<Wall> furnished_room() {
  std::vector<Wall> walls = box(0.0, 0.0, 10.0, 6.0);
  for (const auto& piece : {box(4.0, 0.0, 5.0, 1.2), box(7.0, 4.0, 7.5, 4.5)}) {
    walls.insert(walls.end(), piece.begin(), piece.end());
  }
  return walls;
}

inline LaserScan scan_at(const std::vector<Wall>& walls, const Pose2& map_T_base, double time_s, Rng& rng,
                         double fov_rad = kPi, double range_max_m = 12.0, double sigma_m = 0.01) {
  constexpr int kBeams = 361;
  LaserScan scan;
  scan.stamp = robot_time_s(time_s);
  scan.angle_min_rad = -fov_rad / 2.0;
  scan.angle_step_rad = fov_rad / (kBeams - 1);
  scan.range_max_m = range_max_m;
  scan.base_T_laser = {0.15, 0.0, 0.0};
  const Pose2 map_T_laser = map_T_base * scan.base_T_laser;
  for (int k = 0; k < kBeams; ++k) {
    const double angle_rad = map_T_laser.theta_rad + scan.angle_rad(static_cast<std::size_t>(k));
    const Point2 direction(std::cos(angle_rad), std::sin(angle_rad));
    const double range_m = testing::ray_to_walls(walls, map_T_laser.translation(), direction, range_max_m);
    scan.ranges_m.push_back(range_m < range_max_m ? static_cast<float>(range_m + rng.normal(sigma_m)) : kNoReturn);
  }
  return scan;
}

}  // namespace seeker::slam
