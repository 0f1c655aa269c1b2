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

struct Layout {
  const char* world;
  int paper_cells;  ///< spec S3.6; 0: not in the paper
};
constexpr std::array kLayouts{Layout{"paper-a", 20}, Layout{"paper-b", 17}};
constexpr std::size_t kSmallestLayouts = 1;
constexpr const char* kEmptyWorld = "no-target";

RunSpec spec_of(const ReproduceParams& params, const std::string& world, std::uint64_t seed) {
  RunSpec spec;
  spec.robot_file = params.config / "robots" / "sim.yaml";
  spec.world_file = params.config / "worlds" / (world + ".yaml");
  spec.strategy = search::Strategy::kPaper;
  spec.seed = seed;
  spec.overrides = params.overrides;
  return spec;
}

std::filesystem::path trajectory_file(const ReproduceParams& params, const std::string& world) {
  return params.out / ("fig6-" + world + ".png");
}

Status draw_trajectory(const ReproduceParams& params, const std::string& world, const RunRecord& record) {
  const std::string title =
      "Search of layout " + world + ", strategy as printed, seed " + std::to_string(record.result.seed);
  return image::write_png(trajectory_file(params, world), draw_in_world(record, title));
}

/// The runs of one world; the first seed also leaves its Fig 6.
Result<std::vector<RunResult>> run_world(const ReproduceParams& params, const std::string& world) {
  std::vector<RunSpec> specs;
  for (const std::uint64_t seed : params.seeds) {
    specs.push_back(spec_of(params, world, seed));
  }
  const ExperimentParams experiment{.out = params.out, .jobs = params.jobs, .show_progress = params.show_progress};
  const RecordSink sink = [&](const RunSpec& spec, const RunRecord& record) {
    return spec.seed == params.seeds.front() ? draw_trajectory(params, world, record) : Status();
  };
  Result<std::vector<RunResult>> results = run_missing(specs, experiment, sink);
  if (results && !std::filesystem::exists(trajectory_file(params, world))) {
    const Result<RunRecord> record = run_search(specs.front());
    const Status drawn =
        record ? draw_trajectory(params, world, *record) : Status(tl::unexpected<Error>(record.error()));
    if (!drawn) {
      return tl::unexpected<Error>(drawn.error());
    }
  }
  return results;
}

/// R5's last condition: a run without target ends by itself, with the area covered.
Check check_empty(const std::vector<RunResult>& runs) {
  const std::string wanted(to_string(api::Outcome::kNotFoundAreaCovered));
  std::vector<std::uint64_t> seeds;
  int ended = 0;
  double covered_min = 1.0;
  double cells = 0.0;
  for (const RunResult& run : runs) {
    seeds.push_back(run.seed);
    ended += run.outcome == wanted && run.false_finds == 0 ? 1 : 0;
    covered_min = std::min(covered_min, run.covered_share);
    cells += static_cast<double>(run.cells_searched) / static_cast<double>(runs.size());
  }
  return {.id = "R5",
          .passed = !runs.empty() && ended == static_cast<int>(runs.size()),
          .figures = {{"layout", kEmptyWorld},
                      {"outcome", wanted},
                      {"ended", std::to_string(ended) + "/" + std::to_string(runs.size())},
                      {"covered_min", fixed(covered_min, 3)},
                      {"cells_mean", fixed(cells, 1)},
                      {"seeds", print_seeds(seeds)}}};
}

Status draw_figures(const ReproduceParams& params) {
  if (Status ok = image::write_png(params.out / "fig3-memberships.png", membership_figure()); !ok) {
    return ok;
  }
  const RunSpec spec = spec_of(params, kLayouts[0].world, params.seeds.front());
  const Result<Image> stages = stages_figure(spec, params.out / "fig4");
  if (!stages) {
    return tl::unexpected<Error>(stages.error());
  }
  return image::write_png(params.out / "fig4-stages.png", *stages);
}

Status check_layouts(const ReproduceParams& params, Report& report) {
  std::vector<RunResult> all;
  for (const Layout& layout : std::span(kLayouts).first(params.smallest ? kSmallestLayouts : kLayouts.size())) {
    const Result<std::vector<RunResult>> runs = run_world(params, layout.world);
    if (!runs) {
      return tl::unexpected<Error>(runs.error());
    }
    report.add(check_layout(*runs, layout.paper_cells));
    all.insert(all.end(), runs->begin(), runs->end());
  }
  const Result<std::vector<RunResult>> empty = run_world(params, kEmptyWorld);
  if (!empty) {
    return tl::unexpected<Error>(empty.error());
  }
  report.add(check_empty(*empty));
  all.insert(all.end(), empty->begin(), empty->end());
  if (Status ok = files::write_file(params.out / "runs.csv", runs_csv(all)); !ok) {
    return ok;
  }
  return files::write_file(params.out / "summary.csv", summary_csv(summarise(all)));
}

}  // namespace

Status reproduce_search(const ReproduceParams& params, Report& report) {
  std::error_code error;
  std::filesystem::create_directories(params.out, error);
  check_bearings(report);
  check_rules(params.config, report);
  if (Status ok = draw_figures(params); !ok) {
    return ok;
  }
  if (Status ok = check_layouts(params, report); !ok) {
    return ok;
  }
  if (!params.sockets) {
    return {};
  }
  return check_mission_scripts({.programs = params.programs.empty() ? own_folder() : params.programs,
                                .config = params.config,
                                .out = params.out},
                               report);
}

}  // namespace seeker::lab
