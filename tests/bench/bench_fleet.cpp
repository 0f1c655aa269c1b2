/// \file
/// Exploration of the arena of 20 x 20 m (spec S4.10) by one to four robots that do not know where the others began,
/// and what each of them would send to the main one. Robot time: the table's own column is the time of the computer.
#include <benchmark/benchmark.h>

#include "server/lab/active_slam/explore_run.hpp"
#include "server/lab/map_merging/fleet_run.hpp"
#include "tests/support/data.hpp"

namespace {

using namespace seeker;  // NOLINT: a benchmark program

constexpr std::uint64_t kSeeds = 2;
constexpr double kTimeLimit_s = 3600.0;

template <class Spec>
Spec spec_of(std::uint64_t seed) {
  Spec spec;
  spec.robot_file = testing::source_file("config/robots/arena.yaml");
  spec.world_file = testing::source_file("config/worlds/arena-20.yaml");
  spec.time_limit_s = kTimeLimit_s;
  spec.seed = seed;
  return spec;
}

/// Robot time, way and contacts of one robot; what else there is to tell of several.
void explore_alone(benchmark::State& state) {
  double time_s = 0.0;
  double path_m = 0.0;
  for (auto _ : state) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      auto spec = spec_of<lab::ExploreSpec>(seed);
      spec.strategy = api::ExploreStrategy::kTopological;
      const auto run = lab::run_explore(spec);
      if (!run) {
        state.SkipWithError(run.error().message.c_str());
        return;
      }
      time_s += run->result.robot_time_s / kSeeds;
      path_m += run->result.path_length_m / kSeeds;
    }
  }
  state.counters["robot_time_s"] = time_s;
  state.counters["path_m"] = path_m;
}
BENCHMARK(explore_alone)->Unit(benchmark::kSecond)->Iterations(1);

void explore_together(benchmark::State& state) {
  lab::FleetResult mean;
  double merged = 0.0;
  for (auto _ : state) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      auto spec = spec_of<lab::FleetSpec>(seed);
      spec.robots = static_cast<int>(state.range(0));
      spec.count_traffic = true;
      const auto run = lab::run_fleet(spec);
      if (!run) {
        state.SkipWithError(run.error().message.c_str());
        return;
      }
      mean.world_time_s += run->world_time_s / kSeeds;
      mean.path_length_m += run->path_length_m / kSeeds;
      mean.sent_bytes += run->sent_bytes / kSeeds;
      mean.seen_m2 += run->seen_m2 / kSeeds;
      mean.contacts += run->contacts;
      merged += static_cast<double>(run->merged) / run->pairs / kSeeds;
    }
  }
  state.counters["robot_time_s"] = mean.world_time_s;
  state.counters["path_m"] = mean.path_length_m;
  state.counters["merged_pairs"] = merged;
  state.counters["contacts"] = mean.contacts;
  state.counters["sent_kB_robot"] = 1e-3 * mean.sent_bytes;
  state.counters["sent_B_m2_robot"] = mean.sent_bytes / mean.seen_m2;
}
BENCHMARK(explore_together)->Arg(2)->Arg(3)->Arg(4)->Unit(benchmark::kSecond)->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
