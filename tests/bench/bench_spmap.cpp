/// \file
/// Cost of the SPmap's steps with N segments in the map: an office of parallel walls, 12 of which are seen.
#include <benchmark/benchmark.h>

#include "server/slam/sp_map.hpp"

namespace {

using namespace seeker;  // NOLINT: a benchmark program

/// Walls a metre apart to the robot's left, each 0.8 m long, both ends real or not.
std::vector<lines::SegmentObservation> walls(std::size_t count, bool real) {
  std::vector<lines::SegmentObservation> seen;
  for (std::size_t k = 0; k < count; ++k) {
    lines::SegmentObservation one;
    const auto row = static_cast<double>(k / 10);
    const double turn_rad = k % 2 == 0 ? 0.0 : 1.5;
    one.base_T_segment = {static_cast<double>(k % 10) - 4.5, 1.0 + row, turn_rad};
    one.length_m = 0.8;
    one.real = {real, real};
    one.covariance << 1e-4, 0.0, 0.0, 1e-4;
    one.end_sigma_m = {0.03, 0.03};
    one.points = 40;
    seen.push_back(one);
  }
  return seen;
}

slam::SpMap map_of(std::size_t count, bool real) {
  slam::SpMapParams params;
  params.features.real_scans = 1;
  slam::SpMap map({}, 1e-4 * Matrix3::Identity(), params);
  const std::vector<lines::SegmentObservation> all = walls(count, real);
  map.update(all, map.associate(all));
  map.predict({}, 1e-4 * Matrix3::Identity());
  return map;
}

constexpr std::size_t kSeen = 12;

void associate(benchmark::State& state) {
  const slam::SpMap map = map_of(static_cast<std::size_t>(state.range(0)), state.range(1) != 0);
  const std::vector<lines::SegmentObservation> seen = walls(kSeen, state.range(1) != 0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(map.associate(seen));
  }
}

void predict(benchmark::State& state) {
  slam::SpMap map = map_of(static_cast<std::size_t>(state.range(0)), state.range(1) != 0);
  const Matrix3 noise = 1e-12 * Matrix3::Identity();
  for (auto _ : state) {
    map.predict({0.001, 0.0, 0.0}, noise);
    map.predict({-0.001, 0.0, 0.0}, noise);
  }
}

void update(benchmark::State& state) {
  slam::SpMap map = map_of(static_cast<std::size_t>(state.range(0)), state.range(1) != 0);
  const std::vector<lines::SegmentObservation> seen = walls(kSeen, state.range(1) != 0);
  const slam::Association association = map.associate(seen);
  for (auto _ : state) {
    benchmark::DoNotOptimize(map.update(seen, association));
  }
  if (map.segments().size() != static_cast<std::size_t>(state.range(0))) {
    state.SkipWithError("the map changed");
  }
}

void sizes(benchmark::internal::Benchmark* bench) {
  for (const int real : {0, 1}) {
    for (const int segments : {50, 100, 250, 500}) {
      bench->Args({segments, real});
    }
  }
  bench->ArgNames({"N", "real_ends"});
}

BENCHMARK(update)->Apply(sizes);
BENCHMARK(associate)->Apply(sizes);
BENCHMARK(predict)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
