/// \file
/// Line extraction with covariances: scans per second, and how good the lines are. Quality counters: true and false
/// positives in percent, spreads of r and alpha over those of fits to the true walls, mean NEES (2 is right). The first
/// benchmark is the textbook method.
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "server/drivers/replay/replay.hpp"
#include "server/lines/fast_extractor.hpp"
#include "server/lines/observation.hpp"
#include "server/lines/paper_extractor.hpp"
#include "server/lines/split_extractors.hpp"
#include "tests/support/carmen_scans.hpp"
#include "tests/support/data.hpp"
#include "tests/support/lines/scoring.hpp"

namespace {

using namespace seeker;  // NOLINT: a benchmark program
using seeker::testing::ScannerModel;

constexpr int kRooms = 300;
constexpr std::uint64_t kSeed = 7;

struct Rooms {
  std::vector<testing::TrueScan> scans;
  std::vector<std::vector<testing::WallRun>> runs;
};

Rooms make_rooms(const ScannerModel& model) {
  Rooms rooms;
  Rng rng(kSeed);
  for (int k = 0; k < kRooms; ++k) {
    const testing::Room room = testing::random_room(rng);
    rooms.scans.push_back(testing::scan_room(room, model, rng));
    rooms.runs.push_back(testing::wall_runs(room, rooms.scans.back(), {}));
  }
  return rooms;
}

lines::FastParams fast_params() {
  const testing::ScoringParams scoring;
  lines::FastParams params;
  params.min_points = scoring.min_points;
  params.min_length_m = scoring.min_length_m;
  return params;
}

template <class Extract>
void report_quality(benchmark::State& state, const Rooms& rooms, const Extract& extract) {
  const testing::ScoringParams scoring;
  testing::LineScore found;
  testing::LineScore oracle;
  for (std::size_t k = 0; k < rooms.scans.size(); ++k) {
    testing::score_scan(rooms.runs[k], extract(rooms.scans[k].scan), scoring, found);
    testing::score_scan(rooms.runs[k], testing::oracle_lines(rooms.runs[k], rooms.scans[k]), scoring, oracle);
  }
  constexpr double kPercent = 100.0;
  state.counters["TP"] = kPercent * found.true_positive();
  state.counters["FP"] = kPercent * found.false_positive();
  state.counters["r_ratio"] = found.r_spread_m() / oracle.r_spread_m();
  state.counters["alpha_ratio"] = found.alpha_spread_rad() / oracle.alpha_spread_rad();
  state.counters["NEES"] = found.nees_mean();
  state.counters["lines"] = found.lines;
}

/// One scan after the other, one an iteration.
template <class Extract>
void run_rooms(benchmark::State& state, const ScannerModel& model, const Extract& extract) {
  const Rooms rooms = make_rooms(model);
  std::size_t next = 0;
  for (auto _ : state) {
    extract(rooms.scans[next].scan);
    next = next + 1 < rooms.scans.size() ? next + 1 : 0;
  }
  state.SetItemsProcessed(state.iterations());
}

void split_and_merge_rooms(benchmark::State& state, const ScannerModel& model) {
  lines::SplitParams params;
  params.split_m = 5.0 * model.sigma_m;
  params.min_points = fast_params().min_points;
  params.min_length_m = fast_params().min_length_m;
  const lines::SplitAndMerge extractor(params);
  run_rooms(state, model, [&](const LaserScan& scan) { benchmark::DoNotOptimize(extractor.extract(scan)); });
  report_quality(state, make_rooms(model), [&](const LaserScan& scan) { return extractor.extract(scan); });
}

void paper_rooms(benchmark::State& state, const ScannerModel& model) {
  lines::PaperParams params;
  params.min_points = fast_params().min_points;
  params.min_length_m = fast_params().min_length_m;
  const lines::PaperExtractor extractor(params);
  run_rooms(state, model, [&](const LaserScan& scan) { benchmark::DoNotOptimize(extractor.extract(scan)); });
  report_quality(state, make_rooms(model), [&](const LaserScan& scan) { return extractor.extract(scan); });
}

void fast_rooms(benchmark::State& state, const ScannerModel& model) {
  lines::FastExtractor extractor(fast_params());
  lines::ScanLines found;
  run_rooms(state, model, [&](const LaserScan& scan) {
    extractor.extract(scan, found);
    benchmark::DoNotOptimize(found.lines.data());
  });
  report_quality(state, make_rooms(model), [&](const LaserScan& scan) { return extractor.extract(scan); });
}

BENCHMARK_CAPTURE(split_and_merge_rooms, 361_180_1cm, ScannerModel::half_circle(361, 0.01));
BENCHMARK_CAPTURE(paper_rooms, 361_180_1cm, ScannerModel::half_circle(361, 0.01));
BENCHMARK_CAPTURE(fast_rooms, 361_180_1cm, ScannerModel::half_circle(361, 0.01));
BENCHMARK_CAPTURE(fast_rooms, 361_180_2cm, ScannerModel::half_circle(361, 0.02));
BENCHMARK_CAPTURE(fast_rooms, 181_180_1cm, ScannerModel::half_circle(181, 0.01));
BENCHMARK_CAPTURE(fast_rooms, 181_180_2cm, ScannerModel::half_circle(181, 0.02));
BENCHMARK_CAPTURE(fast_rooms, 360_360_1cm, ScannerModel::full_circle(360, 0.01));
BENCHMARK_CAPTURE(fast_rooms, 360_360_2cm, ScannerModel::full_circle(360, 0.02));
BENCHMARK_CAPTURE(fast_rooms, 720_360_1cm, ScannerModel::full_circle(720, 0.01));
BENCHMARK_CAPTURE(fast_rooms, 720_360_2cm, ScannerModel::full_circle(720, 0.02));

std::vector<LaserScan> recorded_scans(const char* path) {
  std::vector<LaserScan> scans;
  if (const auto file = testing::recorded_data(path)) {
    for (const drivers::CarmenScan& scan : testing::carmen_scans(*file).value_or(std::vector<drivers::CarmenScan>())) {
      scans.push_back(drivers::to_laser_scan(scan, {}, robot_time_s(scan.stamp_s)));
    }
  }
  return scans;
}

void fast_log(benchmark::State& state, const char* path) {
  const std::vector<LaserScan> scans = recorded_scans(path);
  if (scans.empty()) {
    state.SkipWithError("no recorded data: set SEEKER_DATA to the folder that has it");
    return;
  }
  lines::FastExtractor extractor(fast_params());
  lines::ScanLines found;
  std::size_t next = 0;
  std::size_t lines_found = 0;
  double sigma_m = 0.0;
  for (auto _ : state) {
    extractor.extract(scans[next], found);
    lines_found += found.lines.size();
    sigma_m += found.range_sigma_m;
    next = next + 1 < scans.size() ? next + 1 : 0;
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["lines_per_scan"] =
      benchmark::Counter(static_cast<double>(lines_found), benchmark::Counter::kAvgIterations);
  state.counters["sigma_mm"] = benchmark::Counter(1e3 * sigma_m, benchmark::Counter::kAvgIterations);
}
BENCHMARK_CAPTURE(fast_log, fr079, "lidar/fr079.clf.gz");
BENCHMARK_CAPTURE(fast_log, intel, "lidar/intel.clf.gz");

void observe_rooms(benchmark::State& state) {
  const Rooms rooms = make_rooms(ScannerModel::half_circle(361, 0.01));
  lines::FastExtractor extractor;
  std::vector<lines::ScanLines> found;
  for (const testing::TrueScan& truth : rooms.scans) {
    found.push_back(extractor.extract(truth.scan));
  }
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(lines::observe(rooms.scans[next].scan, found[next]));
    next = next + 1 < rooms.scans.size() ? next + 1 : 0;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(observe_rooms);

}  // namespace

BENCHMARK_MAIN();
