/// \file
/// A world of line segments and a noisy laser in it, for the tests of this folder.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "common/core/scan.hpp"

namespace seeker::slam {

using Wall = std::pair<Point2, Point2>;

inline std::vector<Wall> box(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}}, {{x1, y0}, {x1, y1}}, {{x1, y1}, {x0, y1}}, {{x0, y1}, {x0, y0}}};
}

/// A room of 10 x 6 m with a cupboard and a pillar.
inline std::vector<Wall> furnished_room() {
  std::vector<Wall> walls = box(0.0, 0.0, 10.0, 6.0);
  for (const auto& piece : {box(4.0, 0.0, 5.0, 1.2), box(7.0, 4.0, 7.5, 4.5)}) {
    walls.insert(walls.end(), piece.begin(), piece.end());
  }
  return walls;
}

inline double cast(const std::vector<Wall>& walls, const Point2& from, double angle_rad, double max_m) {
  const Point2 d(std::cos(angle_rad), std::sin(angle_rad));
  double nearest = max_m;
  for (const auto& [a, b] : walls) {
    const Point2 e = b - a;
    const double cross = d.x() * e.y() - d.y() * e.x();
    if (std::abs(cross) < 1e-12) {
      continue;
    }
    const Point2 w = a - from;
    const double t = (w.x() * e.y() - w.y() * e.x()) / cross;
    const double u = (w.x() * d.y() - w.y() * d.x()) / cross;
    if (t > 0.0 && u >= 0.0 && u <= 1.0 && t < nearest) {
      nearest = t;
    }
  }
  return nearest;
}

inline LaserScan scan_at(const std::vector<Wall>& walls, const Pose2& map_T_base, double time_s, Rng& rng,
                         double fov_rad = kPi, double range_max_m = 12.0) {
  constexpr int kBeams = 361;
  constexpr double kSigma_m = 0.01;
  LaserScan scan;
  scan.stamp = robot_time_s(time_s);
  scan.angle_min_rad = -fov_rad / 2.0;
  scan.angle_step_rad = fov_rad / (kBeams - 1);
  scan.range_max_m = range_max_m;
  scan.base_T_laser = {0.15, 0.0, 0.0};
  const Pose2 map_T_laser = map_T_base * scan.base_T_laser;
  for (int k = 0; k < kBeams; ++k) {
    const double angle_rad = map_T_laser.theta_rad + scan.angle_rad(static_cast<std::size_t>(k));
    const double range_m = cast(walls, map_T_laser.translation(), angle_rad, range_max_m);
    scan.ranges_m.push_back(range_m < range_max_m ? static_cast<float>(range_m + rng.normal(kSigma_m)) : kNoReturn);
  }
  return scan;
}

}  // namespace seeker::slam
