/// \file
/// The control table against fuzzylite's inference on the same inputs: speed, equality at the nodes, mean and largest
/// difference between them (the counters of BM_LookUp*).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "server/search/control_table.hpp"
#include "server/search/fuzzy_planner.hpp"
#include "server/search/fuzzy_rules.hpp"
#include "server/search/mamdani.hpp"

namespace {

using namespace seeker;
using namespace seeker::search;

constexpr std::size_t kInputs = 4096;
constexpr std::uint64_t kSeed = 7;

struct Input {
  Sectors sectors;
  double target_rad = 0.0;
};

/// Half of the distances where the sets bend, the rest anywhere.
const std::vector<Input>& inputs() {
  static const std::vector<Input> all = [] {
    Rng rng(kSeed);
    std::vector<Input> made(kInputs);
    for (Input& input : made) {
      for (double& d : input.sectors.distance_m) {
        d = rng.uniform() < 0.5 ? rng.uniform(0.0, 1.2) : rng.uniform(0.0, kMaxDistance_m);
      }
      input.target_rad = rng.uniform(-kPi, kPi);
    }
    return made;
  }();
  return all;
}

FuzzyPlanner make_planner() {
  auto planner = FuzzyPlanner::create(generate_fll());
  if (!planner) {
    std::fprintf(stderr, "%s\n", planner.error().message.c_str());
    std::exit(1);
  }
  return std::move(*planner);
}

ControlTable make_table(const ControlTableParams& params) {
  auto table = ControlTable::create(params);
  if (!table) {
    std::fprintf(stderr, "%s\n", table.error().message.c_str());
    std::exit(1);
  }
  return std::move(*table);
}

/// Largest difference at randomly chosen nodes; the interior ones of the target's axis.
double difference_at_nodes(const ControlTable& table, FuzzyPlanner& planner) {
  Rng rng(kSeed);
  double largest = 0.0;
  for (std::size_t k = 0; k < kInputs / 4; ++k) {
    Sectors sectors;
    for (double& d : sectors.distance_m) {
      d = table.params().distances_m[rng.below(table.params().distances_m.size())];
    }
    const double target =
        table.target_node_rad(1 + static_cast<int>(rng.below(static_cast<std::uint64_t>(table.target_nodes() - 2))));
    largest = std::max(largest, std::abs(*table.look_up(sectors, target) - *planner.infer(sectors, target)));
  }
  return largest;
}

void report_differences(benchmark::State& state, const ControlTable& table) {
  FuzzyPlanner planner = make_planner();
  double sum = 0.0;
  double largest = 0.0;
  for (const Input& input : inputs()) {
    const double d =
        std::abs(*table.look_up(input.sectors, input.target_rad) - *planner.infer(input.sectors, input.target_rad));
    sum += d;
    largest = std::max(largest, d);
  }
  state.counters["nodes"] = static_cast<double>(table.size());
  state.counters["node_max_rad"] = difference_at_nodes(table, planner);
  state.counters["mean_rad"] = sum / kInputs;
  state.counters["max_rad"] = largest;
}

void look_up(benchmark::State& state, const ControlTableParams& params) {
  const ControlTable table = make_table(params);
  std::size_t k = 0;
  for (auto _ : state) {
    const Input& input = inputs()[k++ % kInputs];
    benchmark::DoNotOptimize(table.look_up(input.sectors, input.target_rad));
  }
  report_differences(state, table);
}

void BM_LookUp(benchmark::State& state) { look_up(state, {}); }
void BM_LookUpFine(benchmark::State& state) { look_up(state, ControlTableParams::fine()); }

void BM_Fuzzylite(benchmark::State& state) {
  FuzzyPlanner planner = make_planner();
  std::size_t k = 0;
  for (auto _ : state) {
    const Input& input = inputs()[k++ % kInputs];
    benchmark::DoNotOptimize(planner.infer(input.sectors, input.target_rad));
  }
}

void BM_OwnInference(benchmark::State& state) {
  const MamdaniPlanner planner;
  std::size_t k = 0;
  for (auto _ : state) {
    const Input& input = inputs()[k++ % kInputs];
    benchmark::DoNotOptimize(planner.infer(input.sectors, input.target_rad));
  }
}

void BM_FillTable(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(make_table({}));
  }
}

BENCHMARK(BM_LookUp);
BENCHMARK(BM_LookUpFine)->Unit(benchmark::kNanosecond);
BENCHMARK(BM_Fuzzylite);
BENCHMARK(BM_OwnInference);
BENCHMARK(BM_FillTable)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
