// What one tick of the simulated robot costs on the office floor.
#include <benchmark/benchmark.h>

#include "server/sim/furniture.hpp"
#include "server/sim/simulation.hpp"

namespace seeker::sim {
namespace {

/// A floor like the office: rooms, doors, furniture; about 250 faces.
World floor_of_rooms() {
  World world;
  world.name = "bench";
  world.max_corner = {24.0, 14.0};
  const auto wall = [&world](double ax, double ay, double bx, double by, double thickness) {
    Wall w;
    w.a = {ax, ay};
    w.b = {bx, by};
    w.thickness_m = thickness;
    w.surface.pattern = static_cast<std::uint32_t>(world.walls.size());
    world.walls.push_back(w);
  };
  wall(0, 0, 24, 0, 0);
  wall(24, 0, 24, 14, 0);
  wall(24, 14, 0, 14, 0);
  wall(0, 14, 0, 0, 0);
  for (int room = 0; room < 5; ++room) {
    const double x = 4.8 * room;
    for (const double y : {6.0, 8.0}) {
      wall(x, y, x + 2.0, y, 0.12);
      wall(x + 3.0, y, x + 4.8, y, 0.12);
    }
    if (room > 0) {
      wall(x, 0, x, 5.9, 0.12);
      wall(x, 8.1, x, 14, 0.12);
    }
    for (const double y : {1.0, 12.5}) {
      const std::vector<Box> table = make_table(Pose2{x + 1.2, y, 0.2}, {}, {});
      world.boxes.insert(world.boxes.end(), table.begin(), table.end());
      world.boxes.push_back({Pose2{x + 3.8, y, 0.0}, 0.6, 0.5, 0.0, 1.2, {}});
    }
  }
  Target target;
  target.name = "target";
  target.world_T_target = {6.0, 7.2, 0.5};
  target.picture = Image(128, 299, 1, 200);
  world.targets.push_back(target);
  world.starts = {Pose2{3.0, 7.0, 0.0}};
  return world;
}

Simulation make() { return std::move(*Simulation::create(floor_of_rooms(), RobotModel{}, 1)); }

void scan_361_beams(benchmark::State& state) {
  Simulation s = make();
  for (auto _ : state) {
    benchmark::DoNotOptimize(s.scan());
  }
}
BENCHMARK(scan_361_beams)->Unit(benchmark::kMicrosecond);

void sonar_ring(benchmark::State& state) {
  Simulation s = make();
  for (auto _ : state) {
    benchmark::DoNotOptimize(s.sonar());
  }
}
BENCHMARK(sonar_ring)->Unit(benchmark::kMicrosecond);

void omni_picture_640x480(benchmark::State& state) {
  Simulation s = make();
  benchmark::DoNotOptimize(s.omni_image());  // the tables
  for (auto _ : state) {
    benchmark::DoNotOptimize(s.omni_image());
  }
}
BENCHMARK(omni_picture_640x480)->Unit(benchmark::kMillisecond);

void tick_of_100_ms(benchmark::State& state) {
  Simulation s = make();
  for (auto _ : state) {
    s.command({0.2, 0.3});
    s.advance(std::chrono::milliseconds(100));
  }
}
BENCHMARK(tick_of_100_ms)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace seeker::sim

BENCHMARK_MAIN();
