#include "server/lab/efficiency/reproduce_efficiency.hpp"

#include <algorithm>
#include <iterator>
#include <span>

#include "common/image/png.hpp"
#include "server/lab/active_slam/explore_experiment.hpp"
#include "server/lab/active_slam/explore_picture.hpp"
#include "server/lab/efficiency/tour_command.hpp"
#include "server/lab/experiments/seeds.hpp"

namespace seeker::lab {
namespace {

using api::ExploreStrategy;

constexpr ExploreStrategy kStrategies[] = {ExploreStrategy::kTour, ExploreStrategy::kHorizon,
                                           ExploreStrategy::kFrontier, ExploreStrategy::kGain,
                                           ExploreStrategy::kActive};
constexpr ExploreStrategy kSmallest[] = {ExploreStrategy::kTour, ExploreStrategy::kFrontier};

/// No building is smaller.
constexpr double kLeastFloor_m2 = 0.01;

std::filesystem::path world_file_of(const ReproduceParams& params, const EfficiencyWorld& world) {
  return params.config / "worlds" / (world.name + ".yaml");
}

std::vector<ExploreSpec> specs_of(const ReproduceParams& params, const EfficiencyWorld& world) {
  ExploreSpec spec;
  spec.robot_file = params.config / "robots" / (world.robot + ".yaml");
  spec.world_file = world_file_of(params, world);
  spec.time_limit_s = world.time_limit_s;
  spec.overrides = params.overrides;
  std::vector<ExploreSpec> specs;
  const std::span<const ExploreStrategy> strategies(params.smallest ? std::span<const ExploreStrategy>(kSmallest)
                                                                    : std::span<const ExploreStrategy>(kStrategies));
  for (const ExploreStrategy strategy : strategies) {
    if (params.takes_strategy(to_string(strategy))) {
      spec.strategy = strategy;
      const std::vector<ExploreSpec> runs = with_seeds(spec, params.seeds);
      specs.insert(specs.end(), runs.begin(), runs.end());
    }
  }
  return specs;
}

Status draw_curves(const ReproduceParams& params, const EfficiencyWorld& world, const std::vector<ExploreSpec>& specs) {
  const Result<std::vector<NamedCurve>> curves = curves_of_seed(specs, params.seeds.front(), params.out);
  if (!curves) {
    return tl::unexpected<Error>(curves.error());
  }
  const std::string title = world.name + ", seed " + std::to_string(params.seeds.front()) + ": floor known over path";
  return image::write_png(params.out / ("floor-" + world.name + ".png"), floor_figure(title, *curves));
}

/// Measures the yardstick and draws it.
Status measure(const ReproduceParams& params, EfficiencyRuns& world) {
  TourOptions options;
  options.building = world_file_of(params, world.world);
  const Result<MeasuredTour> measured = measure_tour(options);
  if (!measured) {
    return tl::unexpected<Error>(measured.error());
  }
  world.open_tour_m = measured->tour.open_tour_m;
  world.floor_m2 = measured->tour.coverage.floor_m2;
  return image::write_png(params.out / ("tour-" + world.world.name + ".png"),
                          draw_tour(*measured, world.world.name + ": " + fixed(world.open_tour_m, 1) + " m one way"));
}

/// One strategy's figures in one world.
std::vector<std::string> row_of(const EfficiencyRuns& world, const std::vector<const ExploreResult*>& runs) {
  constexpr double kPercent = 100.0;
  const auto values = [&](auto value) {
    std::vector<double> all;
    std::transform(runs.begin(), runs.end(), std::back_inserter(all), [&](const auto* run) { return value(*run); });
    return mean_spread(all);
  };
  const auto cell = [](const MeanSpread& spread, int digits) {
    return fixed(spread.mean, digits) + " +- " + fixed(spread.sigma, digits);
  };
  const MeanSpread path_m = values([](const ExploreResult& run) { return run.path_length_m; });
  const auto complete = std::count_if(runs.begin(), runs.end(), [](const ExploreResult* run) {
    return run->outcome == to_string(api::Outcome::kComplete);
  });
  const MeanSpread floor = values(
      [&](const ExploreResult& run) { return kPercent * run.floor_m2 / std::max(world.floor_m2, kLeastFloor_m2); });
  return {
      world.world.name,
      runs.front()->strategy,
      std::to_string(runs.size()),
      cell(path_m, 1),
      cell(values([](const ExploreResult& run) { return run.robot_time_s; }), 0),
      world.open_tour_m > 0.0 ? fixed(path_m.mean / world.open_tour_m, 2) : "-",
      cell(values([](const ExploreResult& run) { return kPercent * run.wall_share; }), 1),
      cell(floor, 1),
      cell(values([](const ExploreResult& run) { return run.mean_error_m; }), 4),
      fixed(values([](const ExploreResult& run) { return run.contacts; }).mean * static_cast<double>(runs.size()), 0),
      std::to_string(complete) + "/" + std::to_string(runs.size())};
}

Status write_tables(const std::filesystem::path& out, const std::vector<EfficiencyRuns>& worlds) {
  std::vector<ExploreResult> all;
  for (const EfficiencyRuns& world : worlds) {
    all.insert(all.end(), world.runs.begin(), world.runs.end());
  }
  return write_explore_tables(out, efficiency_table(worlds), all);
}

}  // namespace

const std::vector<EfficiencyWorld>& efficiency_worlds() {
  static const std::vector<EfficiencyWorld> worlds = {
      {.name = "demo", .robot = "explore-office"},
      {.name = "corridor", .robot = "explore-paper"},
      {.name = "office", .robot = "explore-office", .path_share = 0.85, .time_share = 0.75},
      {.name = "arena-20", .robot = "explore-office"},
      {.name = "floor-40", .robot = "explore-large", .time_limit_s = 14400.0},
      {.name = "open-plan", .robot = "explore-large", .time_limit_s = 14400.0},
      {.name = "hospital", .robot = "explore-large", .time_limit_s = 14400.0, .path_share = 0.75, .time_share = 0.70}};
  return worlds;
}

Table efficiency_table(const std::vector<EfficiencyRuns>& worlds) {
  Table table({"world", "strategy", "seeds", "path, m", "time, s", "ratio", "walls, %", "floor, %", "error, m",
               "contacts", "complete"});
  for (const EfficiencyRuns& world : worlds) {
    for (const ExploreStrategy strategy : kStrategies) {
      std::vector<const ExploreResult*> runs;
      for (const ExploreResult& run : world.runs) {
        if (run.strategy == to_string(strategy)) {
          runs.push_back(&run);
        }
      }
      if (!runs.empty()) {
        table.add(row_of(world, runs));
      }
    }
  }
  return table;
}

Status reproduce_efficiency(const ReproduceParams& params, Report& report) {
  std::error_code error;
  std::filesystem::create_directories(params.out, error);
  std::vector<EfficiencyRuns> worlds;
  for (const EfficiencyWorld& world : efficiency_worlds()) {
    if (!params.takes_world(world.name) || (params.smallest && &world != &efficiency_worlds().front())) {
      continue;
    }
    EfficiencyRuns& runs = worlds.emplace_back();
    runs.world = world;
    if (Status ok = measure(params, runs); !ok) {
      return ok;
    }
    const std::vector<ExploreSpec> specs = specs_of(params, world);
    Result<std::vector<ExploreResult>> results = explore_missing(specs, params.out, params.jobs, params.show_progress);
    if (!results) {
      return tl::unexpected<Error>(results.error());
    }
    runs.runs = std::move(*results);
    if (Status ok = draw_curves(params, world, specs); !ok) {
      return ok;
    }
    check_efficiency(runs, report);
    if (Status ok = write_tables(params.out, worlds); !ok) {
      return ok;
    }
  }
  return {};
}

}  // namespace seeker::lab
