/// \file
/// Relocalisation in recorded buildings: time a query, and what the verdicts are worth. The queries are scans that did
/// not make the map, alone or put together over some metres. Without recordings (SEEKER_DATA) only the synthetic one
/// runs.
#include <iostream>
#include <map>
#include <string>

#include <benchmark/benchmark.h>

#include "tests/support/data.hpp"
#include "tests/unit/server/slam/recorded_places.hpp"
#include "tests/unit/server/slam/rooms.hpp"

namespace {

using namespace seeker;  // NOLINT: a benchmark program

constexpr double kTolerance_m = 0.5;
constexpr double kTolerance_rad = 0.17;
constexpr std::size_t kEvery = 12;  ///< scans between queries

struct Building {
  slam::RecordedWalk walk;
  std::shared_ptr<const slam::PlaceMap> map;
};

/// The log with its loops closed, and its map; null where there is no recording.
const Building* building(const std::string& name) {
  static std::map<std::string, Building> cache;
  if (const auto known = cache.find(name); known != cache.end()) {
    return &known->second;
  }
  const auto path = testing::recorded_data("lidar/" + name + ".clf.gz");
  auto walk = path ? slam::walk_through(*path) : std::nullopt;
  if (!walk) {
    return nullptr;
  }
  Building made;
  const slam::ClosedLoops loops = slam::close_loops(*walk);
  made.walk = *std::move(walk);
  made.map = std::make_shared<const slam::PlaceMap>(*slam::PlaceMap::build(made.walk.map()));
  std::cout << name << ": " << loops.submaps << " sub-maps, " << loops.loops << " loops found and sub-maps built in "
            << loops.detect_s << " s, grid " << made.map->pyramid().width() << " x " << made.map->pyramid().height()
            << " cells, " << 1e-6 * static_cast<double>(made.map->pyramid().bytes()) << " MB\n";
  return &(cache[name] = std::move(made));
}

void report(benchmark::State& state, const slam::PlaceTally& tally) {
  state.counters["queries"] = static_cast<double>(tally.queries);
  state.counters["unique_%"] = 100.0 * tally.share(tally.unique);
  state.counters["ambiguous_%"] = 100.0 * tally.share(tally.ambiguous);
  state.counters["none_%"] = 100.0 * tally.share(tally.none);
  state.counters["wrong_%"] = 100.0 * tally.share(tally.wrong);
}

/// A window of +-4 m and +-0.5 rad, as a loop is searched for.
void search_window(benchmark::State& state) {
  Rng rng(1);
  std::vector<slam::SeenPoints> seen;
  for (const Pose2& pose : {Pose2{2.5, 3.0, 0.0}, Pose2{8.0, 2.0, 1.0}, Pose2{6.0, 3.0, -2.0}}) {
    seen.push_back(
        slam::transform(pose, slam::seen_points(slam::scan_at(slam::furnished_room(), pose, 0.0, rng, kTwoPi))));
  }
  const auto map = slam::PlaceMap::build(seen);
  const auto query = slam::seen_points(slam::scan_at(slam::furnished_room(), {3.0, 3.2, 0.3}, 1.0, rng)).points;
  const slam::SearchWindow window{{2.0, 2.2, 0.0}, 4.0, 0.5};
  for (auto _ : state) {
    benchmark::DoNotOptimize(slam::GlobalMatcher().search(map->pyramid(), query, window));
  }
}
BENCHMARK(search_window)->Unit(benchmark::kMillisecond);

void build_submap(benchmark::State& state) {
  Rng rng(1);
  std::vector<slam::SeenPoints> seen;
  for (int k = 0; k < 10; ++k) {
    const Pose2 pose{2.0 + 0.5 * k, 3.0, 0.0};
    seen.push_back(
        slam::transform(pose, slam::seen_points(slam::scan_at(slam::furnished_room(), pose, 0.0, rng, kTwoPi))));
  }
  slam::PlaceMapParams params;
  params.pyramid.coarse_level = 2;
  for (auto _ : state) {
    benchmark::DoNotOptimize(slam::PlaceMap::build(seen, params));
  }
}
BENCHMARK(build_submap)->Unit(benchmark::kMillisecond);

/// Scans of `queries` in the map of `mapped`, put together over `travel_m`.
void relocalise(benchmark::State& state, const std::string& mapped, const std::string& queries, double travel_m) {
  const Building* map = building(mapped);
  const Building* from = building(queries);
  if (map == nullptr || from == nullptr) {
    state.SkipWithError("no recording; set SEEKER_DATA to the folder that has it");
    return;
  }
  const slam::PlaceRecogniser recogniser;
  slam::PlaceTally tally;
  std::size_t k = kEvery / 2;
  for (auto _ : state) {
    state.PauseTiming();
    while (map == from && from->walk.keyframe[k % from->walk.poses.size()]) {
      ++k;
    }
    k = k % from->walk.poses.size();
    const auto scans = from->walk.gathered(k, travel_m);
    state.ResumeTiming();
    const slam::PlaceAnswer answer = recogniser.locate(*map->map, scans);
    state.PauseTiming();
    tally.add(answer, map == from ? std::optional<Pose2>(from->walk.poses[k]) : std::nullopt, kTolerance_m,
              kTolerance_rad);
    k += kEvery;
    state.ResumeTiming();
  }
  report(state, tally);
}
BENCHMARK_CAPTURE(relocalise, intel_one_scan, "intel", "intel", 0.0)->Unit(benchmark::kMillisecond)->Iterations(220);
BENCHMARK_CAPTURE(relocalise, intel_2m, "intel", "intel", 2.0)->Unit(benchmark::kMillisecond)->Iterations(220);
BENCHMARK_CAPTURE(relocalise, intel_4m, "intel", "intel", 4.0)->Unit(benchmark::kMillisecond)->Iterations(220);
BENCHMARK_CAPTURE(relocalise, fr079_one_scan, "fr079", "fr079", 0.0)->Unit(benchmark::kMillisecond)->Iterations(390);
BENCHMARK_CAPTURE(relocalise, fr079_4m, "fr079", "fr079", 4.0)->Unit(benchmark::kMillisecond)->Iterations(390);
BENCHMARK_CAPTURE(relocalise, fr079_in_intel_one_scan, "intel", "fr079", 0.0)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(390);
BENCHMARK_CAPTURE(relocalise, fr079_in_intel_2m, "intel", "fr079", 2.0)->Unit(benchmark::kMillisecond)->Iterations(390);
BENCHMARK_CAPTURE(relocalise, intel_in_fr079_one_scan, "fr079", "intel", 0.0)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(220);

}  // namespace

BENCHMARK_MAIN();
