#include "server/lab/map_merging/reproduce_map_merging.hpp"

#include <algorithm>

#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/app/composition/robot_assembly.hpp"
#include "server/lab/active_slam/explore_experiment.hpp"
#include "server/lab/active_slam/explore_picture.hpp"
#include "server/lab/experiments/log_stopwatch.hpp"
#include "server/vision/picture.hpp"
#include "server/vision/place_index.hpp"
#include "server/vision/sift_features.hpp"

namespace seeker::lab {
namespace {

constexpr const char* kWorld = "arena-20";
constexpr const char* kTrapWorld = "twin-corridors";
constexpr const char* kRobot = "arena";
constexpr double kTimeLimit_s = 3600.0;
constexpr double kLoadPeriod_s = 1.0;

ExploreSpec spec_of(const ReproduceParams& params, std::uint64_t seed, const std::string& world = kWorld) {
  ExploreSpec spec;
  spec.robot_file = params.config / "robots" / (std::string(kRobot) + ".yaml");
  spec.world_file = params.config / "worlds" / (world + ".yaml");
  spec.strategy = api::ExploreStrategy::kTopological;
  spec.time_limit_s = kTimeLimit_s;
  spec.overrides = params.overrides;
  spec.seed = seed;
  return spec;
}

std::vector<FleetSpec> fleet_specs(const ReproduceParams& params, const std::string& world) {
  std::vector<FleetSpec> specs;
  specs.reserve(params.seeds.size());
  for (const std::uint64_t seed : params.seeds) {
    FleetSpec spec;
    static_cast<SimSpec&>(spec) = spec_of(params, seed, world);
    specs.push_back(std::move(spec));
  }
  return specs;
}

Table fleet_table(const std::vector<FleetResult>& runs) {
  Table table({"seed", "robots", "merged", "pairs", "wrong", "merged_at_s", "error_m", "error_deg", "complete",
               "world_time_s", "path_m", "contacts", "robot_contacts", "waited_s", "first_end_s"});
  for (const FleetResult& run : runs) {
    table.add({std::to_string(run.seed), std::to_string(run.robots), std::to_string(run.merged),
               std::to_string(run.pairs), std::to_string(run.wrong), fixed(run.merged_at_s, 1), fixed(run.error_m, 3),
               fixed(run.error_deg, 2), std::to_string(run.complete), fixed(run.world_time_s, 1),
               fixed(run.path_length_m, 1), std::to_string(run.contacts), std::to_string(run.robot_contacts),
               fixed(run.waited_s, 1), fixed(run.first_end_s, 1)});
  }
  return table;
}

/// The tree of the first scan of a robot.
Status draw_tree(const ReproduceParams& params, Report& report) {
  const Result<app::RobotOptions> options = sim_options(spec_of(params, params.seeds.front()));
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  const Result<app::Assembly> assembly = app::assemble(*options);
  if (!assembly) {
    return tl::unexpected<Error>(assembly.error());
  }
  const fleet::SpaceTreeParams& tree_params = options->topology.map.tree;
  const LaserScan scan = assembly->simulation->scan();
  const fleet::SpaceTree tree = fleet::build_space_tree(scan, tree_params);
  report.add(check_tree(scan, tree, tree_params));
  return image::write_png(params.out / "fig3-tree.png", tree_figure(scan, tree, tree_params));
}

/// What a second of the run costs, with the camera looking once a second. Taking the picture stands for the camera, so
/// that it is not counted.
class LoadMeter {
 public:
  void look(const app::RobotLoop& loop, sim::Simulation& simulation) {
    const double time_s = to_seconds(loop.now());
    if (samples_.empty() || time_s >= samples_.back().time_s + kLoadPeriod_s) {
      const double loop_s = thread_seconds() - since_s_;
      const Image picture = simulation.omni_image();
      const double before_s = thread_seconds();
      const auto features = vision::detect_sift(vision::to_grey_mat(picture), vision::place_detector_params());
      samples_.push_back({.time_s = time_s,
                          .loop_s = samples_.empty() ? 0.0 : loop_s,
                          .features_s = thread_seconds() - before_s,
                          .features = static_cast<int>(features.size()),
                          .node = loop.neighbours().own().topology.nodes.size() > nodes_});
      nodes_ = loop.neighbours().own().topology.nodes.size();
      since_s_ = thread_seconds();
    }
  }
  [[nodiscard]] const std::vector<LoadSample>& samples() const { return samples_; }

 private:
  std::vector<LoadSample> samples_;
  std::size_t nodes_ = 0;
  double since_s_ = 0.0;
};

/// Figs 6 and 11 by one run of the first seed; its numbers.
Result<ExploreResult> draw_single(const ReproduceParams& params, Report& report) {
  LoadMeter meter;
  const ExploreSpec spec = spec_of(params, params.seeds.front());
  const Result<ExploreRecord> record = run_explore(
      spec, [&meter](const app::RobotLoop& loop, sim::Simulation& simulation) { meter.look(loop, simulation); });
  if (!record) {
    return tl::unexpected<Error>(record.error());
  }
  const Image map = draw_exploration(*record, "One robot by topology, seed " + std::to_string(spec.seed));
  if (Status ok = image::write_png(params.out / "fig6-single.png", map); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  report.add(check_keyframes(meter.samples()));
  if (Status ok = image::write_png(params.out / "fig11-load.png", load_figure(meter.samples())); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return record->result;
}

/// Explorations of one robot: figures, tables and their condition. The smallest form is the one run of the figures.
Result<std::vector<ExploreResult>> run_single(const ReproduceParams& params, Report& report) {
  const Result<ExploreResult> drawn = draw_single(params, report);
  if (!drawn) {
    return tl::unexpected<Error>(drawn.error());
  }
  std::vector<ExploreSpec> specs;
  specs.reserve(params.seeds.size());
  for (const std::uint64_t seed : params.seeds) {
    specs.push_back(spec_of(params, seed));
  }
  Result<std::vector<ExploreResult>> runs = params.smallest
                                                ? std::vector<ExploreResult>{*drawn}
                                                : explore_missing(specs, params.out, params.jobs, params.show_progress);
  if (!runs) {
    return runs;
  }
  report.add(check_single(*runs));
  if (Status ok = files::write_file(params.out / "runs.csv", explore_runs_table(*runs).csv()); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (Status ok = files::write_file(params.out / "table.csv", explore_summary_table(*runs).csv()); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  return runs;
}

}  // namespace

Status reproduce_map_merging(const ReproduceParams& params, Report& report) {
  std::error_code error;
  std::filesystem::create_directories(params.out, error);
  if (Status ok = draw_tree(params, report); !ok) {
    return ok;
  }
  const Result<std::vector<ExploreResult>> runs = run_single(params, report);
  if (!runs) {
    return tl::unexpected<Error>(runs.error());
  }
  const auto fleets = fleet_missing(fleet_specs(params, kWorld), params.out, params.show_progress);
  if (!fleets) {
    return tl::unexpected<Error>(fleets.error());
  }
  report.add(check_merges(*fleets));
  report.add(check_sharing(*fleets, *runs));
  if (Status ok = files::write_file(params.out / "fleet.csv", fleet_table(*fleets).csv()); !ok) {
    return ok;
  }
  if (params.smallest) {
    return {};
  }
  const auto trapped = fleet_missing(fleet_specs(params, kTrapWorld), params.out, params.show_progress);
  if (!trapped) {
    return tl::unexpected<Error>(trapped.error());
  }
  report.add(check_trap(*trapped));
  return files::write_file(params.out / "trap.csv", fleet_table(*trapped).csv());
}

}  // namespace seeker::lab
