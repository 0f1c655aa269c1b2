/// \file
/// Merging against the size of the map: a robot's 9 local maps looked for among 9, 99 and 999 of another, and ICP of
/// one scan. Blocks of offices stand in a row; the robots share one of them.
#include <map>

#include <benchmark/benchmark.h>

#include "server/fleet/icp.hpp"
#include "server/fleet/map_merger.hpp"
#include "tests/unit/server/fleet/toy_maps.hpp"

namespace {

using namespace seeker;  // NOLINT: a benchmark program

constexpr double kBlock_m = 30.0;
constexpr std::size_t kNodesPerBlock = 3;

const std::vector<Point2> kThere{{1.0, 6.0}, {23.0, 6.0}};
const std::vector<Point2> kAgain{{1.5, 5.9}, {22.5, 6.1}};

/// One map over the blocks from `first` on; each block is seen on its own, which costs less than all walls together.
LineMap street(std::uint64_t first, std::size_t blocks, const std::vector<Point2>& way, std::uint64_t seed) {
  const Matrix3 covariance = Eigen::Vector3d(4e-4, 4e-4, 4e-6).asDiagonal();
  LineMap all;
  for (std::size_t k = 0; k < blocks; ++k) {
    const auto poses = fleet::drive(way);
    const LineMap block = fleet::toy_map(fleet::office(first + k), poses, seed + k);
    const Pose2 map_T_block = Pose2{kBlock_m * static_cast<double>(k), 0.0, 0.0} * poses.front();
    const auto offset = static_cast<std::uint32_t>(kNodesPerBlock * k);
    for (MapNode node : block.nodes) {
      node.id += offset;
      node.map_T_node = map_T_block * node.map_T_node;
      if (!all.nodes.empty()) {
        const MapNode& last = all.nodes.back();
        all.edges.push_back({last.id, node.id, inverse(last.map_T_node) * node.map_T_node, covariance, false, true});
      }
      all.nodes.push_back(node);
    }
    for (MapKeyframe keyframe : block.keyframes) {
      keyframe.node += offset;
      all.keyframes.push_back(keyframe);
    }
  }
  return all;
}

void prepare(benchmark::State& state) {
  const LineMap map = street(1, static_cast<std::size_t>(state.range(0)) / kNodesPerBlock, kThere, 1);
  for (auto _ : state) {
    fleet::PreparedMap made;
    benchmark::DoNotOptimize(made.update(map));
  }
}
BENCHMARK(prepare)->Arg(9)->Arg(99)->Arg(999)->Unit(benchmark::kMillisecond)->Iterations(1);

/// As a server that has asked before: maps are prepared, regions of the large one are made when they are asked for.
void merge_nodes(benchmark::State& state) {
  fleet::PreparedMap a =
      fleet::prepared(street(1, static_cast<std::size_t>(state.range(0)) / kNodesPerBlock, kThere, 1));
  fleet::PreparedMap b = fleet::prepared(street(2, 3, kAgain, 7));
  double merged = 0.0;
  for (auto _ : state) {
    merged += fleet::MapMerger().merge(a, b).merged() ? 1.0 : 0.0;
  }
  state.counters["nodes"] = static_cast<double>(a.nodes().size());
  state.counters["merged"] = merged / static_cast<double>(state.iterations());
}
BENCHMARK(merge_nodes)->Arg(9)->Arg(99)->Arg(999)->Unit(benchmark::kMillisecond)->Iterations(2);

void icp_one_scan(benchmark::State& state) {
  Rng rng(1);
  const auto walls = fleet::office(1);
  const slam::ReferenceCloud reference(slam::seen_points(fleet::scan_from(walls, {6.0, 6.0, 0.1}, rng)).points);
  const auto points = slam::seen_points(fleet::scan_from(walls, {6.3, 6.1, 0.4}, rng)).points;
  for (auto _ : state) {
    benchmark::DoNotOptimize(fleet::icp(reference, points, {}));
  }
}
BENCHMARK(icp_one_scan)->Unit(benchmark::kMillisecond);

/// The same by points to lines, as the merger ends each search.
void icp_point_to_line(benchmark::State& state) {
  Rng rng(1);
  const auto walls = fleet::office(1);
  const slam::ReferenceCloud reference(slam::seen_points(fleet::scan_from(walls, {6.0, 6.0, 0.1}, rng)).points);
  const auto points = slam::seen_points(fleet::scan_from(walls, {6.3, 6.1, 0.4}, rng)).points;
  for (auto _ : state) {
    benchmark::DoNotOptimize(slam::ScanMatcher().match(reference, points, {0.0, 0.0, 0.3}));
  }
}
BENCHMARK(icp_point_to_line)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
