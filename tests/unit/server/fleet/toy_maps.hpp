/// \file
/// Maps of robots that drove through a world of line segments: local maps with scans, without an estimator.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "common/core/line_map.hpp"
#include "common/core/rng.hpp"
#include "server/fleet/prepared_map.hpp"
#include "tests/support/toy_world.hpp"

namespace seeker::fleet {

using testing::box;
using testing::Wall;

inline void add(std::vector<Wall>& walls, const std::vector<Wall>& more) {
  walls.insert(walls.end(), more.begin(), more.end());
}

inline LaserScan scan_from(const std::vector<Wall>& walls, const Pose2& world_T_base, Rng& rng,
                           double range_max_m = 10.0) {
  constexpr int kBeams = 361;
  constexpr double kSigma_m = 0.01;
  LaserScan scan;
  scan.angle_min_rad = -kPi / 2.0;
  scan.angle_step_rad = kPi / (kBeams - 1);
  scan.range_max_m = range_max_m;
  for (std::size_t k = 0; k < kBeams; ++k) {
    const double angle_rad = world_T_base.theta_rad + scan.angle_rad(k);
    const Point2 direction(std::cos(angle_rad), std::sin(angle_rad));
    const double range_m = testing::ray_to_walls(walls, world_T_base.translation(), direction, range_max_m);
    scan.ranges_m.push_back(range_m < range_max_m ? static_cast<float>(range_m + rng.normal(kSigma_m)) : kNoReturn);
  }
  return scan;
}

/// Poses every 0.4 m along straight lines between the corners, looking ahead, with a look back at each corner.
inline std::vector<Pose2> drive(const std::vector<Point2>& corners) {
  constexpr double kStep_m = 0.4;
  std::vector<Pose2> poses;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const Point2 leg = corners[k + 1] - corners[k];
    const double heading_rad = std::atan2(leg.y(), leg.x());
    const int steps = static_cast<int>(std::ceil(leg.norm() / kStep_m));
    for (int i = 0; i < steps; ++i) {
      const Point2 p = corners[k] + leg * (static_cast<double>(i) / steps);
      poses.push_back({p.x(), p.y(), heading_rad});
    }
    poses.push_back({corners[k + 1].x(), corners[k + 1].y(), wrap_angle(heading_rad + kPi)});
  }
  return poses;
}

/// What the robot believes of its path: each step between local maps is off by noise of these deviations.
struct ToyDrift {
  double sigma_m = 0.02;
  double sigma_rad = 0.004;
};

/// The map of a robot that went there; its frame is the first pose. A local map every `poses_per_node` poses.
inline LineMap toy_map(const std::vector<Wall>& walls, const std::vector<Pose2>& world_T_base, std::uint64_t seed,
                       const ToyDrift& drift = {}, std::size_t poses_per_node = 20) {
  Rng rng(seed);
  LineMap map;
  Pose2 world_T_node;
  for (std::size_t k = 0; k < world_T_base.size(); ++k) {
    if (k % poses_per_node == 0) {
      const auto id = static_cast<std::uint32_t>(map.nodes.size());
      if (id == 0) {
        map.nodes.push_back({id, {}, {}});
      } else {
        Pose2 step = inverse(world_T_node) * world_T_base[k];
        step = step * Pose2{rng.normal(drift.sigma_m), rng.normal(drift.sigma_m), rng.normal(drift.sigma_rad)};
        const Matrix3 covariance =
            Eigen::Vector3d(drift.sigma_m, drift.sigma_m, drift.sigma_rad).cwiseAbs2().asDiagonal();
        map.edges.push_back({id - 1, id, step, covariance, false, true});
        map.nodes.push_back({id, map.nodes.back().map_T_node * step, {}});
      }
      world_T_node = world_T_base[k];
    }
    map.keyframes.push_back(pack_keyframe(scan_from(walls, world_T_base[k], rng), map.nodes.back().id,
                                          inverse(world_T_node) * world_T_base[k]));
  }
  return map;
}

inline PreparedMap prepared(const LineMap& map) {
  PreparedMap made;
  const Status taken = made.update(map);
  SEEKER_ASSERT(taken.has_value());
  return made;
}

/// An office of 24 x 12 m: a corridor with four rooms on either side, each with its own door and furniture.
/// `seed` decides both: other seeds are other buildings.
inline std::vector<Wall> office(std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Wall> walls = box(0.0, 0.0, 24.0, 12.0);
  for (const double side : {0.0, 1.0}) {
    const double wall_y = 5.0 + 2.0 * side;
    double x = 0.0;
    for (int room = 0; room < 4; ++room) {
      const double width = room == 3 ? 24.0 - x : rng.uniform(4.6, 7.0);
      const double door = x + rng.uniform(0.8, width - 1.8);
      walls.push_back({{x, wall_y}, {door, wall_y}});
      walls.push_back({{door + 1.0, wall_y}, {x + width, wall_y}});
      const double low = side * 7.0;
      if (room < 3) {
        walls.push_back({{x + width, low}, {x + width, low + 5.0}});
      }
      for (int piece = 0; piece < 3; ++piece) {
        const double px = x + rng.uniform(0.2, width - 1.6);
        const double py = low + (side > 0.0 ? rng.uniform(2.6, 4.2) : rng.uniform(0.2, 1.8));
        add(walls, box(px, py, px + rng.uniform(0.4, 1.2), py + rng.uniform(0.3, 0.8)));
      }
      x += width;
    }
  }
  return walls;
}

/// Two corridors of 20 x 2 m, alike to the last door post, with a passage between them at their left ends.
inline std::vector<Wall> twin_corridors() {
  std::vector<Wall> walls{{{-2.0, 0.0}, {-2.0, 12.0}}, {{0.0, 2.0}, {0.0, 10.0}}};
  for (const double y : {0.0, 10.0}) {
    walls.push_back({{20.0, y}, {20.0, y + 2.0}});
    for (const double side_y : {y, y + 2.0}) {
      const double deep = side_y > y ? 0.3 : -0.3;  // doors stand back from the wall
      double x = side_y == 2.0 || side_y == 10.0 ? 0.0 : -2.0;
      for (double door = 2.0; door < 19.0; door += 4.0) {
        walls.push_back({{x, side_y}, {door, side_y}});
        walls.push_back({{door, side_y}, {door, side_y + deep}});
        walls.push_back({{door, side_y + deep}, {door + 1.0, side_y + deep}});
        walls.push_back({{door + 1.0, side_y + deep}, {door + 1.0, side_y}});
        x = door + 1.0;
      }
      walls.push_back({{x, side_y}, {20.0, side_y}});
    }
  }
  return walls;
}

/// The same corridors, open at their left ends to a hall of 10 x 12 m in which no place is like another.
inline std::vector<Wall> twin_corridors_with_a_hall() {
  std::vector<Wall> walls = twin_corridors();
  walls.front() = {{-12.0, 0.0}, {-12.0, 12.0}};
  add(walls, {{{-12.0, 0.0}, {-2.0, 0.0}}, {{-12.0, 12.0}, {-2.0, 12.0}}});
  add(walls, box(-10.0, 1.0, -8.8, 2.4));
  add(walls, box(-5.2, 5.4, -4.4, 7.6));
  add(walls, box(-11.5, 7.0, -10.0, 7.6));
  add(walls, box(-3.0, 3.6, -2.2, 4.4));
  add(walls, box(-9.6, 10.2, -9.0, 11.4));
  return walls;
}

}  // namespace seeker::fleet
