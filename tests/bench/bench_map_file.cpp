/// \file
/// Saving and loading of a large map in memory, fsync apart: 10 000 segments are to take less than 20 ms each way.
#include <benchmark/benchmark.h>

#include "server/store/map_file.hpp"
#include "tests/support/maps/random_map.hpp"

namespace {

using namespace seeker;  // NOLINT: a benchmark program

/// 10 000 segments and, as second argument, scans of 361 beams.
store::MapFile large_map(benchmark::State& state) {
  Rng rng(1);
  store::MapFile file;
  file.origin.name = "bench";
  file.map = testing::random_map(rng, {.nodes = 200,
                                       .segments = static_cast<std::size_t>(state.range(0)),
                                       .keyframes = static_cast<std::size_t>(state.range(1)),
                                       .beams = 720});
  return file;
}

void save_map(benchmark::State& state) {
  const store::MapFile file = large_map(state);
  std::size_t size = 0;
  for (auto _ : state) {
    size = store::encode_map_file(file)->size();
  }
  state.counters["file_bytes"] = static_cast<double>(size);
}
BENCHMARK(save_map)->Unit(benchmark::kMillisecond)->Args({10000, 0})->Args({10000, 1000});

void load_map(benchmark::State& state) {
  const std::vector<std::uint8_t> bytes = store::encode_map_file(large_map(state)).value();
  for (auto _ : state) {
    benchmark::DoNotOptimize(store::decode_map_file(bytes));
  }
}
BENCHMARK(load_map)->Unit(benchmark::kMillisecond)->Args({10000, 0})->Args({10000, 1000});

}  // namespace

BENCHMARK_MAIN();
