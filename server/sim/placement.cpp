#include "server/sim/placement.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/core/angle.hpp"
#include "server/sim/body_motion.hpp"
#include "server/sim/scene.hpp"

namespace seeker::sim {
namespace {

constexpr int kAttempts = 40;
constexpr double kClearanceLimit_m = 1.0;

std::size_t count(const Grid<float>& floor) {
  return static_cast<std::size_t>(
      std::count_if(floor.cells().begin(), floor.cells().end(), [](float c) { return c >= 0.0F; }));
}

/// Places with at least this clearance and distance from the start.
std::vector<Point2> candidates(const Grid<float>& floor, const Point2& start, double clearance_m, double distance_m) {
  std::vector<Point2> places;
  for (std::size_t n = 0; n < floor.cells().size(); ++n) {
    const Point2 p = floor.frame().centre_of(floor.cell(n));
    if (floor.cells()[n] >= static_cast<float>(clearance_m) && (p - start).norm() >= distance_m) {
      places.push_back(p);
    }
  }
  return places;
}

}  // namespace

Grid<float> reachable_floor(const World& world, double robot_radius_m, double resolution_m, double robot_height_m) {
  const Scene scene(world);
  RobotModel robot;
  robot.body_height_m = robot_height_m;
  const HeightBand band = body_band(robot);
  const Point2 side = world.max_corner - world.min_corner;
  Grid<float> floor({world.min_corner, resolution_m}, static_cast<int>(std::ceil(side.x() / resolution_m)),
                    static_cast<int>(std::ceil(side.y() / resolution_m)), -1.0F);
  const CellIndex first = floor.frame().cell_of(world.starts.front().translation());
  std::vector<CellIndex> open;
  const auto visit = [&](CellIndex cell) {
    if (!floor.contains(cell) || floor[cell] >= 0.0F) {
      return;
    }
    const double clearance = scene.clearance_m(floor.frame().centre_of(cell), kClearanceLimit_m, band);
    if (clearance >= robot_radius_m || cell == first) {
      floor[cell] = static_cast<float>(clearance);
      open.push_back(cell);
    }
  };
  visit(first);
  while (!open.empty()) {
    const CellIndex cell = open.back();
    open.pop_back();
    visit({cell.i + 1, cell.j});
    visit({cell.i - 1, cell.j});
    visit({cell.i, cell.j + 1});
    visit({cell.i, cell.j - 1});
  }
  return floor;
}

Result<Pose2> place_target(World& world, std::size_t index, Rng& rng, const PlacementParams& params) {
  if (const Status valid = validate(world); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  if (index >= world.targets.size()) {
    return fail(Errc::kNotFound, "world '" + world.name + "' has no target number " + std::to_string(index));
  }
  if (world.targets[index].depth_m <= 0.0) {
    return fail(Errc::kInvalidArgument,
                "target '" + world.targets[index].name + "' is a poster and needs a wall; give it a depth to place it");
  }
  World empty = world;
  empty.targets.erase(empty.targets.begin() + static_cast<std::ptrdiff_t>(index));
  const Grid<float> before = reachable_floor(empty, params.robot_radius_m, params.resolution_m, params.robot_height_m);
  const std::vector<Point2> places =
      candidates(before, world.starts.front().translation(), params.target_clearance_m, params.target_to_start_m);
  const Target& target = world.targets[index];
  // What the target may take from the floor: itself and a robot's radius around it. More: it blocks a passage.
  const double taken_m = std::hypot(target.width_m, target.depth_m) / 2.0 + params.robot_radius_m + params.resolution_m;
  const double taken_cells = kPi * taken_m * taken_m / (params.resolution_m * params.resolution_m);
  for (int attempt = 0; attempt < kAttempts && !places.empty(); ++attempt) {
    const Point2& p = places[rng.below(places.size())];
    World tried = world;
    tried.targets[index].world_T_target = {p.x(), p.y(), rng.uniform(-kPi, kPi)};
    const Grid<float> after = reachable_floor(tried, params.robot_radius_m, params.resolution_m, params.robot_height_m);
    if (static_cast<double>(count(after)) + taken_cells >= static_cast<double>(count(before))) {
      world.targets[index].world_T_target = tried.targets[index].world_T_target;
      return world.targets[index].world_T_target;
    }
  }
  return fail(Errc::kUnreachable,
              "world '" + world.name + "' has no free place for target '" + target.name + "' that the robot can reach");
}

Result<Pose2> place_start(World& world, Rng& rng, const PlacementParams& params) {
  if (const Status valid = validate(world); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  const Grid<float> floor = reachable_floor(world, params.robot_radius_m, params.resolution_m, params.robot_height_m);
  const std::vector<Point2> places =
      candidates(floor, world.starts.front().translation(), params.start_clearance_m, 0.0);
  if (places.empty()) {
    return fail(Errc::kUnreachable, "world '" + world.name + "' has no floor with room for the robot");
  }
  const Point2& p = places[rng.below(places.size())];
  world.starts = {{p.x(), p.y(), rng.uniform(-kPi, kPi)}};
  return world.starts.front();
}

double reachable_area_m2(const World& world, double robot_radius_m, double resolution_m) {
  return static_cast<double>(count(reachable_floor(world, robot_radius_m, resolution_m))) * resolution_m * resolution_m;
}

}  // namespace seeker::sim
