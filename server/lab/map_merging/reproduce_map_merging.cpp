#include "server/lab/map_merging/reproduce_map_merging.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/app/composition/robot_assembly.hpp"
#include "server/lab/active_slam/explore_experiment.hpp"
#include "server/lab/active_slam/explore_picture.hpp"
#include "server/lab/experiments/log_stopwatch.hpp"
#include "server/lab/map_merging/other_buildings.hpp"

namespace seeker::lab {
namespace {

constexpr const char* kWorld = "arena-20";
constexpr const char* kTrapWorld = "twin-corridors";
constexpr const char* kPosterWorld = "twin-posters";
constexpr const char* kTurnedWorld = "half-turn";
constexpr const char* kOthers = "other-buildings";  ///< maps of several worlds against each other
constexpr const char* kPrinted = "printed";
constexpr const char* kOurs = "ours";
constexpr const char* kRobot = "arena";
constexpr double kTimeLimit_s = 3600.0;
constexpr double kLoadPeriod_s = 1.0;
constexpr double kSmallestTime_s = 90.0;  ///< of runs of the smallest form that need not come to their end

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

using Fleets = std::vector<std::pair<std::string, const std::vector<FleetResult>*>>;

/// The runs of each kind of robot, one after the other.
Table fleet_table(const Fleets& fleets) {
  Table table({"robot", "seed", "robots", "merged", "pairs", "wrong", "merged_at_s", "error_m", "error_deg", "complete",
               "world_time_s", "path_m", "contacts", "robot_contacts", "waited_s", "first_end_s", "pictures", "alike"});
  for (const auto& [robot, runs] : fleets) {
    for (const FleetResult& run : *runs) {
      table.add({robot, std::to_string(run.seed), std::to_string(run.robots), std::to_string(run.merged),
                 std::to_string(run.pairs), std::to_string(run.wrong), fixed(run.merged_at_s, 1), fixed(run.error_m, 3),
                 fixed(run.error_deg, 2), std::to_string(run.complete), fixed(run.world_time_s, 1),
                 fixed(run.path_length_m, 1), std::to_string(run.contacts), std::to_string(run.robot_contacts),
                 fixed(run.waited_s, 1), fixed(run.first_end_s, 1), std::to_string(run.pictures),
                 std::to_string(run.alike)});
    }
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

/// What a second of a run costs. The rendering of its pictures stands for the camera and is not counted: its cost is
/// measured on a picture of the meter's own.
class LoadMeter {
 public:
  void look(const app::RobotLoop& loop, sim::Simulation& simulation) {
    const double time_s = to_seconds(loop.now());
    if (!samples_.empty() && time_s < samples_.back().time_s + kLoadPeriod_s) {
      return;
    }
    const double loop_s = thread_seconds() - since_s_;
    const app::PictureWork& work = loop.perception().picture_work();
    const std::size_t nodes = loop.neighbours().own().topology.nodes.size();
    const auto pictures = static_cast<int>(work.pictures - before_.pictures);
    const double rendering_s = pictures * (pictures > 0 ? rendering_of(simulation) : 0.0);
    samples_.push_back({.time_s = time_s,
                        .cpu_s = samples_.empty() ? 0.0 : std::max(0.0, loop_s - rendering_s),
                        .pictures = pictures,
                        .features = static_cast<int>(work.features - before_.features),
                        .node = nodes > nodes_});
    nodes_ = nodes;
    before_ = work;
    since_s_ = thread_seconds();
  }
  [[nodiscard]] const std::vector<LoadSample>& samples() const { return samples_; }

 private:
  static double rendering_of(sim::Simulation& simulation) {
    const double before_s = thread_seconds();
    (void)simulation.omni_image();
    return thread_seconds() - before_s;
  }

  std::vector<LoadSample> samples_;
  app::PictureWork before_;
  std::size_t nodes_ = 0;
  double since_s_ = 0.0;
};

/// A run with features of the camera's pictures at nodes or at all frames.
Result<ExploreRecord> run_measured(ExploreSpec spec, const char* pictures_at, LoadMeter& meter) {
  spec.overrides.emplace_back("fleet.lead=true");  // else nobody wants its pictures
  spec.overrides.push_back(std::string("loop.pictures.at=") + pictures_at);
  return run_explore(
      spec, [&meter](const app::RobotLoop& loop, sim::Simulation& simulation) { meter.look(loop, simulation); });
}

/// Figs 6 and 11 by runs of the first seed; the numbers of the one with keyframes.
Result<ExploreResult> draw_single(const ReproduceParams& params, Report& report) {
  LoadMeter keyframe;
  LoadMeter frame;
  ExploreSpec spec = spec_of(params, params.seeds.front());
  const Result<ExploreRecord> record = run_measured(spec, "nodes", keyframe);
  if (!record) {
    return tl::unexpected<Error>(record.error());
  }
  const Image map = draw_exploration(*record, "One robot by topology, seed " + std::to_string(spec.seed));
  if (Status ok = image::write_png(params.out / "fig6-single.png", map); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  if (params.smallest) {
    spec.time_limit_s = kSmallestTime_s;
  }
  if (const Result<ExploreRecord> frames = run_measured(spec, "frames", frame); !frames) {
    return tl::unexpected<Error>(frames.error());
  }
  report.add(check_keyframes(keyframe.samples(), frame.samples()));
  const Image load = load_figure(keyframe.samples(), frame.samples());
  if (Status ok = image::write_png(params.out / "fig11-load.png", load); !ok) {
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

Result<std::vector<FleetResult>> run_fleets(const ReproduceParams& params, const std::vector<FleetSpec>& specs) {
  return fleet_missing(specs, params.out, params.show_progress);
}

/// Maps of different drawn buildings against each other.
Status run_others(const ReproduceParams& params, Report& report) {
  constexpr double kSmallest_s = 40.0;
  constexpr double kWhole_s = 180.0;
  constexpr std::size_t kSeeds = 2;
  const std::vector<std::string> worlds =
      params.smallest ? std::vector<std::string>{kWorld, "hall"}
                      : std::vector<std::string>{kWorld, "hall", "office", "laboratory", "hospital", kTrapWorld};
  std::vector<ExploreSpec> specs;
  for (const std::string& world : worlds) {
    for (std::size_t k = 0; k < std::min(params.smallest ? 1 : kSeeds, params.seeds.size()); ++k) {
      specs.push_back(spec_of(params, params.seeds[k], world));
      specs.back().time_limit_s = params.smallest ? kSmallest_s : kWhole_s;
    }
  }
  const Result<std::vector<BuildingMap>> maps = map_buildings(specs);
  if (!maps) {
    return tl::unexpected<Error>(maps.error());
  }
  const Result<std::vector<OtherBuildings>> pairs = compare_buildings(*maps);
  if (!pairs) {
    return tl::unexpected<Error>(pairs.error());
  }
  report.add(check_other_buildings(*pairs));
  return files::write_file(params.out / "others.csv", other_buildings_table(*pairs).csv());
}

std::vector<FleetSpec> printed_specs(const ReproduceParams& params) {
  std::vector<FleetSpec> printed = fleet_specs(params, kWorld);
  for (FleetSpec& spec : printed) {
    spec.robot_file = params.config / "robots" / "paper" / "merging-2013.yaml";
    spec.label = kPrinted;
    spec.time_limit_s = params.smallest ? kSmallestTime_s : spec.time_limit_s;
  }
  return printed;
}

/// Two robots as printed, into whose pictures a false pair is injected.
Status mislead_printed(const ReproduceParams& params, Report& report) {
  std::vector<FleetSpec> specs = printed_specs(params);
  for (FleetSpec& spec : specs) {
    spec.inject_false_pair = true;
    spec.label += "-false-pair";
  }
  const auto runs = run_fleets(params, specs);
  if (!runs) {
    return tl::unexpected<Error>(runs.error());
  }
  report.add(check_printed_false_pairs(*runs));
  return files::write_file(params.out / "false-pair.csv", fleet_table({{kPrinted, &*runs}}).csv());
}

/// Two robots as printed beside two of ours, into whose pictures a false pair is injected; fleet.csv has both.
Status compare_with_printed(const ReproduceParams& params, const std::vector<ExploreResult>& single, Report& report) {
  std::vector<FleetSpec> ours = fleet_specs(params, kWorld);
  for (FleetSpec& spec : ours) {
    spec.inject_false_pair = true;
  }
  const auto our_runs = run_fleets(params, ours);
  if (!our_runs) {
    return tl::unexpected<Error>(our_runs.error());
  }
  const auto printed_runs = run_fleets(params, printed_specs(params));
  if (!printed_runs) {
    return tl::unexpected<Error>(printed_runs.error());
  }
  report.add(check_printed_merges(*printed_runs));
  report.add(check_merges(*our_runs));
  report.add(check_false_pairs(*our_runs));
  report.add(check_sharing(*our_runs, single));
  const std::filesystem::path first =
      params.out / "runs" / kWorld / "fleet-2" / ("seed-" + std::to_string(params.seeds.front()) + ".png");
  std::error_code error;
  std::filesystem::copy_file(first, params.out / "fig10a-merged.png", std::filesystem::copy_options::overwrite_existing,
                             error);
  const Table table = fleet_table({{kPrinted, &*printed_runs}, {kOurs, &*our_runs}});
  return files::write_file(params.out / "fleet.csv", table.csv());
}

/// Places that are the same for the laser, with different posters for the camera: pictures and laser against the laser
/// alone.
Status compare_posters(const ReproduceParams& params, const std::string& world, const std::string& id, Report& report) {
  std::vector<FleetSpec> laser = fleet_specs(params, world);
  for (FleetSpec& spec : laser) {
    spec.label = "laser";
    spec.overrides.emplace_back("loop.pictures.at=never");
  }
  const auto with_pictures = run_fleets(params, fleet_specs(params, world));
  if (!with_pictures) {
    return tl::unexpected<Error>(with_pictures.error());
  }
  const auto laser_alone = run_fleets(params, laser);
  if (!laser_alone) {
    return tl::unexpected<Error>(laser_alone.error());
  }
  report.add(check_posters(id, *with_pictures, *laser_alone));
  const Table table = fleet_table({{"pictures-and-laser", &*with_pictures}, {"laser", &*laser_alone}});
  return files::write_file(params.out / (world + ".csv"), table.csv());
}

/// One robot and two of them in the arena: the tree, the figures and the merges.
Status run_arena(const ReproduceParams& params, Report& report) {
  if (Status ok = draw_tree(params, report); !ok) {
    return ok;
  }
  const Result<std::vector<ExploreResult>> runs = run_single(params, report);
  if (!runs) {
    return tl::unexpected<Error>(runs.error());
  }
  if (Status ok = compare_with_printed(params, *runs, report); !ok) {
    return ok;
  }
  return params.smallest ? Status() : mislead_printed(params, report);
}

Status run_posters(const ReproduceParams& params, Report& report) {
  return compare_posters(params, kPosterWorld, "S4-POSTERS", report);
}

Status run_turned(const ReproduceParams& params, Report& report) {
  return compare_posters(params, kTurnedWorld, "S4-TURNED", report);
}

Status run_trap(const ReproduceParams& params, Report& report) {
  const auto trapped = run_fleets(params, fleet_specs(params, kTrapWorld));
  if (!trapped) {
    return tl::unexpected<Error>(trapped.error());
  }
  report.add(check_trap(*trapped));
  return files::write_file(params.out / "trap.csv", fleet_table({{kOurs, &*trapped}}).csv());
}

}  // namespace

std::vector<std::string> map_merging_worlds() { return {kWorld, kOthers, kPosterWorld, kTurnedWorld, kTrapWorld}; }

Status reproduce_map_merging(const ReproduceParams& params, Report& report) {
  std::error_code error;
  std::filesystem::create_directories(params.out, error);
  using Part = Status (*)(const ReproduceParams&, Report&);
  const std::array<std::pair<const char*, Part>, 5> parts{{{kWorld, &run_arena},
                                                           {kOthers, &run_others},
                                                           {kPosterWorld, &run_posters},
                                                           {kTurnedWorld, &run_turned},
                                                           {kTrapWorld, &run_trap}}};
  for (const auto& [world, run] : parts) {
    if (!params.takes_world(world) || (params.smallest && run != &run_arena && run != &run_others)) {
      continue;
    }
    if (Status ok = run(params, report); !ok) {
      return ok;
    }
  }
  return {};
}

}  // namespace seeker::lab
