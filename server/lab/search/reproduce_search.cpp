#include "server/lab/search/reproduce_search.hpp"
#include "server/lab/experiments/seeds.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/lab/experiments/child_process.hpp"
#include "server/lab/experiments/table.hpp"
#include "server/lab/search/mission_scripts.hpp"
#include "server/lab/search/run_picture.hpp"
#include "server/lab/search/search_figures.hpp"
#include "server/lab/search/summary.hpp"

namespace seeker::lab {
namespace {

/// Of the paper's room, spec S3.6.
constexpr std::array kLayouts{PrintedLayout{"paper-a", 20, 4.0}, PrintedLayout{"paper-b", 17, 3.0}};
constexpr std::size_t kSmallestLayouts = 1;
constexpr const char* kEmptyWorld = "no-target";

/// A robot that the searches are made with, and what it leaves behind.
struct ExperimentRobot {
  std::string name;
  std::filesystem::path file;
  api::OnFound on_found;
  std::filesystem::path out;  ///< folder of its runs
  std::string picture;        ///< its pictures of Fig 6 begin with this
};

/// Ours, with its laser and all checks of a recognition; it drives up to what it has found.
ExperimentRobot our_robot(const ReproduceParams& params) {
  return {"sim", params.config / "robots" / "sim.yaml", api::OnFound::kApproach, params.out, "fig6-"};
}

/// The paper's experiment ends with the recognition.
ExperimentRobot printed_robot(const ReproduceParams& params) {
  const std::string name = kPrintedRobot;
  return {name, params.config / "robots" / "paper" / (name + ".yaml"), api::OnFound::kStop, params.out / name,
          "fig6-" + name + "-"};
}

std::filesystem::path world_file(const ReproduceParams& params, const std::string& world) {
  return params.config / "worlds" / (world + ".yaml");
}

RunSpec spec_of(const ReproduceParams& params, const ExperimentRobot& robot, const std::filesystem::path& world,
                std::uint64_t seed) {
  RunSpec spec;
  spec.robot_file = robot.file;
  spec.world_file = world;
  spec.target_folder = params.config / "targets";
  spec.strategy = search::Strategy::kPaper;
  spec.on_found = robot.on_found;
  spec.seed = seed;
  spec.overrides = params.overrides;
  return spec;
}

/// The runs of a robot in one world; the first seed also leaves its Fig 6.
Result<std::vector<RunResult>> run_world(const ReproduceParams& params, const ExperimentRobot& robot,
                                         const std::filesystem::path& world) {
  std::vector<RunSpec> specs;
  for (const std::uint64_t seed : params.seeds) {
    specs.push_back(spec_of(params, robot, world, seed));
  }
  const std::filesystem::path picture = params.out / (robot.picture + world.stem().string() + ".png");
  const auto draw = [&](const RunRecord& record) {
    const std::string title = "Search of layout " + world.stem().string() + " by the robot " + robot.name +
                              ", strategy as printed, seed " + std::to_string(record.result.seed);
    return image::write_png(picture, draw_in_world(record, title));
  };
  const ExperimentParams experiment{.out = robot.out, .jobs = params.jobs, .show_progress = params.show_progress};
  const RecordSink sink = [&](const RunSpec& spec, const RunRecord& record) {
    return spec.seed == params.seeds.front() ? draw(record) : Status();
  };
  Result<std::vector<RunResult>> results = run_missing(specs, experiment, sink);
  if (results && !std::filesystem::exists(picture)) {
    const Result<RunRecord> record = run_search(specs.front());
    if (const Status drawn = record ? draw(*record) : Status(tl::unexpected<Error>(record.error())); !drawn) {
      return tl::unexpected<Error>(drawn.error());
    }
  }
  return results;
}

Status draw_figures(const ReproduceParams& params) {
  if (Status ok = image::write_png(params.out / "fig3-memberships.png", membership_figure()); !ok) {
    return ok;
  }
  const RunSpec spec = spec_of(params, our_robot(params), world_file(params, kLayouts[0].world), params.seeds.front());
  const Result<Image> stages = stages_figure(spec, params.out / "fig4");
  if (!stages) {
    return tl::unexpected<Error>(stages.error());
  }
  return image::write_png(params.out / "fig4-stages.png", *stages);
}

std::span<const PrintedLayout> layouts(const ReproduceParams& params) {
  return std::span(kLayouts).first(params.smallest ? kSmallestLayouts : kLayouts.size());
}

Status write_tables(const std::filesystem::path& folder, const std::vector<RunResult>& runs) {
  if (Status ok = files::write_file(folder / "runs.csv", runs_csv(runs)); !ok) {
    return ok;
  }
  return files::write_file(folder / "summary.csv", summary_csv(summarise(runs)));
}

Status run_our_robot(const ReproduceParams& params, Report& report) {
  const ExperimentRobot robot = our_robot(params);
  std::vector<RunResult> all;
  for (const PrintedLayout& layout : layouts(params)) {
    const Result<std::vector<RunResult>> runs = run_world(params, robot, world_file(params, layout.world));
    if (!runs) {
      return tl::unexpected<Error>(runs.error());
    }
    report.add(check_layout(*runs, layout.cells));
    all.insert(all.end(), runs->begin(), runs->end());
  }
  const Result<std::vector<RunResult>> empty = run_world(params, robot, world_file(params, kEmptyWorld));
  if (!empty) {
    return tl::unexpected<Error>(empty.error());
  }
  report.add(check_empty(robot.name, *empty));
  all.insert(all.end(), empty->begin(), empty->end());
  return write_tables(robot.out, all);
}

/// The paper's room with and without its target.
Status run_printed_robot(const ReproduceParams& params, Report& report) {
  const ExperimentRobot robot = printed_robot(params);
  std::vector<RunResult> all;
  for (const PrintedLayout& layout : layouts(params)) {
    const std::filesystem::path world = world_file(params, layout.world);
    const Result<std::vector<RunResult>> runs = run_world(params, robot, world);
    if (!runs) {
      return tl::unexpected<Error>(runs.error());
    }
    for (Check& row : check_printed_robot(*runs, layout)) {
      report.add(std::move(row));
    }
    all.insert(all.end(), runs->begin(), runs->end());
    const Result<std::filesystem::path> bare = without_targets(world, robot.out / "worlds");
    const Result<std::vector<RunResult>> empty =
        bare ? run_world(params, robot, *bare) : tl::unexpected<Error>(bare.error());
    if (!empty) {
      return tl::unexpected<Error>(empty.error());
    }
    report.add(check_empty(robot.name, *empty));
    all.insert(all.end(), empty->begin(), empty->end());
  }
  return write_tables(robot.out, all);
}

/// R6 with the calibration that the robot as printed is given.
Status check_printed_bearings(const ReproduceParams& params, Report& report) {
  const Result<app::RobotOptions> options = app::load_robot_options(printed_robot(params).file);
  if (!options) {
    return tl::unexpected<Error>(options.error());
  }
  check_bearings(report, options->search.recogniser.view.omni.value_or(vision::OmniCameraParams{}));
  return {};
}

}  // namespace

Status reproduce_search(const ReproduceParams& params, Report& report) {
  std::error_code error;
  std::filesystem::create_directories(params.out, error);
  if (Status ok = check_printed_bearings(params, report); !ok) {
    return ok;
  }
  check_rules(params.config, report);
  if (Status ok = draw_figures(params); !ok) {
    return ok;
  }
  if (Status ok = run_our_robot(params, report); !ok) {
    return ok;
  }
  if (Status ok = run_printed_robot(params, report); !ok) {
    return ok;
  }
  if (!params.sockets) {
    return {};
  }
  return check_mission_scripts({.programs = params.programs.empty() ? own_folder() : params.programs,
                                .config = params.config,
                                .out = params.out,
                                .smallest = params.smallest},
                               report);
}

}  // namespace seeker::lab
