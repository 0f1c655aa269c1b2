/// \file
/// Occupancy from pictures, and a laser inside it, for the tests of this folder.
#pragma once

#include <string>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/occupancy_tile.hpp"
#include "common/core/scan.hpp"
#include "server/nav/ray.hpp"

namespace seeker::nav {

/// One character per `cell_m` x `cell_m` block: '#' occupied, '.' free, ' ' unknown. The first row is the highest y;
/// the lower-left corner lies at the origin.
inline Grid<std::uint8_t> ascii_map(const std::vector<std::string>& rows, double cell_m) {
  const int block = static_cast<int>(std::lround(cell_m / kTileResolution_m));
  const int height = static_cast<int>(rows.size());
  const int width = static_cast<int>(rows.front().size());
  Grid<std::uint8_t> grid(GridFrame{}, width * block, height * block, kUnknownCell);
  for (int j = 0; j < grid.height(); ++j) {
    for (int i = 0; i < grid.width(); ++i) {
      const char c = rows[static_cast<std::size_t>(height - 1 - j / block)][static_cast<std::size_t>(i / block)];
      grid[{i, j}] = c == '#' ? kOccupiedCell : c == '.' ? std::uint8_t{0} : kUnknownCell;
    }
  }
  return grid;
}

/// 361 beams over 180 degrees; distances to the side where the beam enters an occupied cell, to half a cell.
inline LaserScan scan_in(const Grid<std::uint8_t>& world, const Pose2& map_T_base, int beams = 361,
                         double fov_rad = kPi) {
  LaserScan scan;
  scan.angle_min_rad = -fov_rad / 2.0;
  scan.angle_step_rad = fov_rad / (beams - 1);
  scan.range_max_m = 12.0;
  const double resolution_m = world.frame().resolution_m;
  for (int k = 0; k < beams; ++k) {
    const double angle_rad = map_T_base.theta_rad + scan.angle_rad(static_cast<std::size_t>(k));
    const Point2 direction(std::cos(angle_rad), std::sin(angle_rad));
    const Point2 from = (map_T_base.translation() - world.frame().origin) / resolution_m;
    RayWalk walk(from, from + scan.range_max_m / resolution_m * direction);
    float range_m = kNoReturn;
    do {
      if (!world.contains(walk.cell())) {
        break;
      }
      if (world[walk.cell()] == kOccupiedCell) {
        const Point2 centre(walk.cell().i + 0.5, walk.cell().j + 0.5);
        range_m = static_cast<float>(resolution_m * (centre - from).dot(direction));
        break;
      }
    } while (walk.advance());
    scan.ranges_m.push_back(range_m);
  }
  return scan;
}

}  // namespace seeker::nav
