/// \file
/// Cost of the steps of the loop that use a scan, on an office floor of 20 x 15 m seen by 361 beams.
#include <algorithm>
#include <cmath>

#include <benchmark/benchmark.h>

#include "common/core/angle.hpp"
#include "common/core/occupancy_tile.hpp"
#include "server/nav/occupancy_map.hpp"
#include "server/nav/planner.hpp"
#include "server/nav/ray.hpp"
#include "server/nav/visibility.hpp"
#include "server/slam/scan_map_tracker.hpp"

namespace {

using namespace seeker;  // NOLINT: a benchmark program

/// Rooms of 5 x 5 m with doors of 1 m.
Grid<std::uint8_t> office() {
  Grid<std::uint8_t> grid(GridFrame{}, 400, 300, 0);
  for (int j = 0; j < grid.height(); ++j) {
    for (int i = 0; i < grid.width(); ++i) {
      const bool wall = i % 100 < 2 || j % 100 < 2 || i >= 398 || j >= 298;
      const bool border = i < 2 || j < 2 || i >= 398 || j >= 298;
      const bool door = (i % 100 > 40 && i % 100 < 61) || (j % 100 > 40 && j % 100 < 61);
      grid[{i, j}] = wall && (border || !door) ? kOccupiedCell : std::uint8_t{0};
    }
  }
  return grid;
}

LaserScan scan_at(const Grid<std::uint8_t>& world, const Pose2& pose, double time_s) {
  LaserScan scan;
  scan.stamp = robot_time_s(time_s);
  scan.angle_min_rad = -kPi / 2.0;
  scan.angle_step_rad = kPi / 360.0;
  scan.range_max_m = 12.0;
  for (std::size_t k = 0; k < 361; ++k) {
    const double angle_rad = pose.theta_rad + scan.angle_rad(k);
    const Point2 direction(std::cos(angle_rad), std::sin(angle_rad));
    const Point2 from = pose.translation() / kTileResolution_m;
    nav::RayWalk walk(from, from + 240.0 * direction);
    float range_m = kNoReturn;
    while (walk.advance() && world.contains(walk.cell())) {
      if (world[walk.cell()] == kOccupiedCell) {
        const Point2 centre(walk.cell().i + 0.5, walk.cell().j + 0.5);
        range_m = static_cast<float>(kTileResolution_m * (centre - from).dot(direction));
        break;
      }
    }
    scan.ranges_m.push_back(range_m);
  }
  return scan;
}

const Pose2 kPose{7.5, 7.5, 0.3};

void integrate_scan(benchmark::State& state) {
  const LaserScan scan = scan_at(office(), kPose, 0.0);
  nav::OccupancyMap map;
  for (auto _ : state) {
    benchmark::DoNotOptimize(map.integrate(scan, kPose));
  }
}
BENCHMARK(integrate_scan)->Unit(benchmark::kMicrosecond);

void build_cost_map(benchmark::State& state) {
  const auto world = office();
  for (auto _ : state) {
    benchmark::DoNotOptimize(nav::CostMap::build(world));
  }
}
BENCHMARK(build_cost_map)->Unit(benchmark::kMicrosecond);

void plan_across(benchmark::State& state) {
  const auto map = nav::CostMap::build(office());
  for (auto _ : state) {
    benchmark::DoNotOptimize(nav::plan(*map, {1.0, 1.0}, {19.0, 14.0}));
  }
}
BENCHMARK(plan_across)->Unit(benchmark::kMicrosecond);

void distance_field(benchmark::State& state) {
  const auto map = nav::CostMap::build(office());
  for (auto _ : state) {
    benchmark::DoNotOptimize(nav::DistanceField::build(*map, {1.0, 1.0}));
  }
}
BENCHMARK(distance_field)->Unit(benchmark::kMicrosecond);

void visible_cells_5m(benchmark::State& state) {
  const auto world = office();
  const Grid<std::uint8_t> all(world.frame(), world.width(), world.height(), 1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(nav::visible_cells_of(all, world, kPose.translation(), 5.0));
  }
}
BENCHMARK(visible_cells_5m)->Unit(benchmark::kMicrosecond);

void track_scan(benchmark::State& state) {
  const auto world = office();
  slam::ScanMapTracker tracker({}, kPose);
  double time_s = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    time_s += 0.1;
    const Pose2 pose = kPose * Pose2{std::sin(0.2 * time_s), 0.0, 0.3 * std::sin(0.3 * time_s)};
    const LaserScan scan = scan_at(world, pose, time_s);
    state.ResumeTiming();
    benchmark::DoNotOptimize(tracker.predict(pose, scan.stamp));
    benchmark::DoNotOptimize(tracker.update(scan));
  }
}
BENCHMARK(track_scan)->Unit(benchmark::kMicrosecond)->Iterations(1000);

}  // namespace

BENCHMARK_MAIN();
