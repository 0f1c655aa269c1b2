#include "server/lab/active_slam/reproduce_active_slam.hpp"

#include <span>

#include "common/image/png.hpp"
#include "server/lab/active_slam/explore_picture.hpp"
#include "server/lab/experiments/seeds.hpp"

namespace seeker::lab {
namespace {

using api::ExploreStrategy;

constexpr ExploreStrategy kAllStrategies[] = {ExploreStrategy::kActive, ExploreStrategy::kHorizon,
                                              ExploreStrategy::kRoam, ExploreStrategy::kFrontier,
                                              ExploreStrategy::kGain};

/// The folder of the results of the robot as printed.
constexpr const char* kPrinted = "printed";

constexpr ExploreStrategy kPrintedStrategies[] = {ExploreStrategy::kActive, ExploreStrategy::kRoam};

std::vector<ExploreSpec> specs_of(const ReproduceParams& params, const ExploreWorld& world, ExploreStrategy strategy) {
  ExploreSpec spec;
  spec.robot_file = params.config / "robots" / (world.robot + ".yaml");
  spec.world_file = params.config / "worlds" / (world.name + ".yaml");
  spec.strategy = strategy;
  spec.time_limit_s = world.time_limit_s;
  spec.wall_near_m = world.wall_near_m;
  spec.overrides = params.overrides;
  return with_seeds(spec, params.seeds);
}

/// All runs of one world, and their specs.
struct WorldExperiment {
  WorldRuns runs;
  std::vector<ExploreSpec> specs;
};

Result<WorldExperiment> run_world(const ReproduceParams& params, const ExploreWorld& world,
                                  std::span<const ExploreStrategy> strategies) {
  WorldExperiment experiment;
  experiment.runs.world = world;
  for (const ExploreStrategy strategy : strategies) {
    // Roaming needs the times of the active runs, which come first.
    if (!params.takes_strategy(to_string(strategy))) {
      continue;
    }
    std::vector<ExploreSpec> specs = specs_of(params, world, strategy);
    if (strategy == ExploreStrategy::kRoam) {
      for (ExploreSpec& spec : specs) {
        const ExploreResult* active = experiment.runs.find(ExploreStrategy::kActive, spec.seed);
        spec.time_limit_s = active != nullptr ? active->robot_time_s : spec.time_limit_s;
      }
    }
    Result<std::vector<ExploreResult>> results = explore_missing(specs, params.out, params.jobs, params.show_progress);
    if (!results) {
      return tl::unexpected<Error>(results.error());
    }
    experiment.runs.runs.insert(experiment.runs.runs.end(), results->begin(), results->end());
    experiment.specs.insert(experiment.specs.end(), specs.begin(), specs.end());
  }
  return experiment;
}

/// The pictures of the first seed's runs under the names of the paper's figures.
Status copy_maps(const ReproduceParams& params, const WorldExperiment& experiment) {
  for (const ExploreSpec& spec : experiment.specs) {
    if (spec.seed != params.seeds.front()) {
      continue;
    }
    std::string figure = "map-";
    figure = spec.strategy == ExploreStrategy::kRoam ? "fig4-" : figure;
    figure = spec.strategy == ExploreStrategy::kActive ? "fig5-" : figure;
    const std::filesystem::path file =
        params.out / (figure + experiment.runs.world.name + "-" + std::string(to_string(spec.strategy)) + ".png");
    std::error_code error;
    std::filesystem::copy_file(explore_file(params.out, spec, ".png"), file,
                               std::filesystem::copy_options::overwrite_existing, error);
    if (error) {
      return fail(Errc::kIo, file.string() + ": " + error.message() + "; remove the runs of its seed and repeat");
    }
  }
  return {};
}

Status draw_curves(const ReproduceParams& params, const WorldExperiment& experiment) {
  const Result<std::vector<NamedCurve>> curves = curves_of_seed(experiment.specs, params.seeds.front(), params.out);
  if (!curves) {
    return tl::unexpected<Error>(curves.error());
  }
  const std::string& name = experiment.runs.world.name;
  const std::string title = name + ", seed " + std::to_string(params.seeds.front());
  if (Status ok = image::write_png(params.out / ("fig6-" + name + ".png"),
                                   error_figure("Localisation error, " + title, *curves));
      !ok) {
    return ok;
  }
  return image::write_png(params.out / ("fig7-" + name + ".png"), trace_figure("Covariance, " + title, *curves));
}

Status draw_figures(const ReproduceParams& params, const WorldExperiment& experiment) {
  if (Status ok = copy_maps(params, experiment); !ok) {
    return ok;
  }
  return draw_curves(params, experiment);
}

/// The robot as printed in the same world on the same seeds.
Status reproduce_printed(ReproduceParams params, ExploreWorld world, Report& report) {
  params.out /= kPrinted;
  world.robot = world.printed_robot;
  std::error_code error;
  std::filesystem::create_directories(params.out, error);
  const Result<WorldExperiment> experiment = run_world(params, world, kPrintedStrategies);
  if (!experiment) {
    return tl::unexpected<Error>(experiment.error());
  }
  if (Status ok = draw_figures(params, *experiment); !ok) {
    return ok;
  }
  check_figures(experiment->runs, true, report);
  return write_explore_tables(params.out, explore_summary_table(experiment->runs.runs), experiment->runs.runs);
}

}  // namespace

const std::vector<ExploreWorld>& explore_worlds() {
  static const std::vector<ExploreWorld> worlds = {{.name = "corridor",
                                                    .robot = "explore-paper",
                                                    .wall_near_m = 0.10,
                                                    .error_limit_m = 0.10,
                                                    .time_limit_s = 3600.0,
                                                    .printed_robot = "paper/active-slam-2009"},
                                                   {.name = "office",
                                                    .robot = "explore-office",
                                                    .wall_near_m = 0.25,
                                                    .error_limit_m = 0.20,
                                                    .time_limit_s = 7200.0,
                                                    .printed_robot = ""},
                                                   {.name = "hospital",
                                                    .robot = "explore-large",
                                                    .wall_near_m = 0.25,
                                                    .error_limit_m = 0.20,
                                                    .time_limit_s = 14400.0,
                                                    .printed_robot = ""}};
  return worlds;
}

Status reproduce_active_slam(const ReproduceParams& params, Report& report) {
  std::error_code error;
  std::filesystem::create_directories(params.out, error);
  std::vector<ExploreResult> all;
  for (const ExploreWorld& world : explore_worlds()) {
    if (!params.takes_world(world.name) || (params.smallest && &world != &explore_worlds().front())) {
      continue;
    }
    const Result<WorldExperiment> experiment = run_world(params, world, kAllStrategies);
    if (!experiment) {
      return tl::unexpected<Error>(experiment.error());
    }
    if (Status ok = draw_figures(params, *experiment); !ok) {
      return ok;
    }
    check_explorations(experiment->runs, report);
    if (!world.printed_robot.empty()) {
      check_figures(experiment->runs, false, report);
      if (Status ok = reproduce_printed(params, world, report); !ok) {
        return ok;
      }
    }
    all.insert(all.end(), experiment->runs.runs.begin(), experiment->runs.runs.end());
    if (Status ok = write_explore_tables(params.out, explore_summary_table(all), all); !ok) {
      return ok;
    }
  }
  return {};
}

}  // namespace seeker::lab
