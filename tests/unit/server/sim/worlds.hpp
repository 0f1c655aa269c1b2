/// \file
/// Small worlds for the simulator's tests.
#pragma once

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "server/sim/simulation.hpp"

namespace seeker::sim::testing {

/// A square room of side `side_m` around the origin, its walls on the bounds; start at the origin.
inline World square_room(double side_m) {
  World world;
  world.name = "square";
  const double h = side_m / 2.0;
  world.min_corner = {-h, -h};
  world.max_corner = {h, h};
  const Point2 corners[] = {{-h, -h}, {h, -h}, {h, h}, {-h, h}};
  for (std::size_t i = 0; i < 4; ++i) {
    Wall wall;
    wall.a = corners[i];
    wall.b = corners[(i + 1) % 4];
    wall.surface.pattern = static_cast<std::uint32_t>(i);
    world.walls.push_back(wall);
  }
  world.starts = {Pose2{}};
  return world;
}

inline Simulation make(World world, RobotModel model = RobotModel{}, std::uint64_t seed = 1) {
  auto simulation = Simulation::create(std::move(world), std::move(model), seed);
  if (!simulation) {
    ADD_FAILURE() << simulation.error().message;
    std::abort();
  }
  return std::move(*simulation);
}

/// Distance from p along an angle to the walls of square_room.
inline double to_wall_m(const Point2& p, double angle_rad, double side_m) {
  const double h = side_m / 2.0;
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  const double x = c > 0 ? (h - p.x()) / c : (c < 0 ? (-h - p.x()) / c : 1e9);
  const double y = s > 0 ? (h - p.y()) / s : (s < 0 ? (-h - p.y()) / s : 1e9);
  return std::min(x, y);
}

}  // namespace seeker::sim::testing
