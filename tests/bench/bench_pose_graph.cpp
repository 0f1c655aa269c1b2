/// \file
/// Smoothing of a chain with 5 % loops, as slam.md measures it: five iterations, the pattern analysed before.
#include <benchmark/benchmark.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "server/slam/pose_graph.hpp"

namespace {

using namespace seeker;  // NOLINT: a benchmark program

slam::PoseGraph laps(std::size_t nodes) {
  constexpr std::size_t kPerLap = 200;
  Rng rng(1);
  const Pose2 step{0.5, 0.0, kTwoPi / kPerLap};
  const Matrix3 information = Eigen::Vector3d(1e3, 1e3, 1e4).asDiagonal();
  slam::PoseGraph graph;
  std::vector<Pose2> truth;
  Pose2 drifting;
  for (std::size_t k = 0; k < nodes; ++k) {
    truth.push_back(k == 0 ? Pose2{} : truth.back() * step);
    const Pose2 odometry = step * Pose2{rng.normal(0.01), rng.normal(0.01), rng.normal(0.002)};
    drifting = k == 0 ? Pose2{} : drifting * odometry;
    graph.add_node(drifting);
    if (k > 0) {
      (void)graph.add_edge({k - 1, k, odometry, information, slam::EdgeKernel::kNone, 0.0});
    }
    if (k > kPerLap && k % 20 == 0) {
      const std::size_t i = k - kPerLap - rng.below(5);
      (void)graph.add_edge({i, k, inverse(truth[i]) * truth[k], information, slam::EdgeKernel::kHuber, 3.0});
    }
  }
  return graph;
}

void five_iterations(benchmark::State& state) {
  slam::PoseGraph graph = laps(static_cast<std::size_t>(state.range(0)));
  const slam::PoseGraph start = graph;
  (void)graph.optimise(1);
  for (auto _ : state) {
    state.PauseTiming();
    for (std::size_t k = 0; k < start.node_count(); ++k) {
      graph.set_pose(k, start.pose(k));
    }
    state.ResumeTiming();
    const auto report = graph.optimise(5);
    state.counters["iterations"] = report->iterations;
    state.counters["chi2_left"] = report->final_chi2 / report->initial_chi2;
  }
}
BENCHMARK(five_iterations)->Unit(benchmark::kMillisecond)->Arg(4791)->Arg(910)->Arg(20000);

void first_time_with_analysis(benchmark::State& state) {
  const slam::PoseGraph start = laps(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    slam::PoseGraph graph = start;
    benchmark::DoNotOptimize(graph.optimise(5));
  }
}
BENCHMARK(first_time_with_analysis)->Unit(benchmark::kMillisecond)->Arg(4791);

void covariance_of_one_node(benchmark::State& state) {
  slam::PoseGraph graph = laps(static_cast<std::size_t>(state.range(0)));
  (void)graph.optimise(5);
  (void)graph.relative_covariance(0, 1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(graph.relative_covariance(10, graph.node_count() - 1));
  }
}
BENCHMARK(covariance_of_one_node)->Unit(benchmark::kMicrosecond)->Arg(4791);

}  // namespace

BENCHMARK_MAIN();
