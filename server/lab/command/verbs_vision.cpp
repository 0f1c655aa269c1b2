#include <iostream>

#include <CLI/CLI.hpp>

#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "server/lab/command/verbs.hpp"
#include "server/lab/experiments/seeds.hpp"
#include "server/lab/search/hit_rate_study.hpp"
#include "server/lab/search/template_command.hpp"
#include "server/lab/stereo_database/revisit_command.hpp"
#include "server/options/world_options.hpp"

namespace seeker::lab {
namespace {

struct HitRateOptions {
  CommonOptions common;
  std::string world = "office";
  std::string solid;
  HitRateParams params;
};

Status save_study(const std::filesystem::path& out, const std::vector<HitRateBin>& bins, double size_m,
                  const search::HitRate& fit, const search::HitRate& before) {
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (Status ok = files::write_file(out / "hit-rate.csv", hit_rate_csv(bins, size_m, fit)); !ok) {
    return ok;
  }
  if (Status ok = files::write_file(out / "hit-rate.yaml", hit_rate_yaml(fit)); !ok) {
    return ok;
  }
  return image::write_png(out / "hit-rate.png", hit_rate_chart(bins, size_m, fit, before));
}

int run_hit_rate(HitRateOptions o) {
  const Result<std::vector<std::uint64_t>> seeds = parse_seeds(o.common.seeds);
  if (!seeds) {
    return report_error(seeds.error().message);
  }
  o.params.seeds = *seeds;
  o.params.spec.robot_file = robot_file(o.common);
  o.params.spec.world_file = world_file(o.common, o.world);
  o.params.spec.overrides = o.common.overrides;
  const Result<app::RobotOptions> options = options_of(o.params.spec);
  const Result<sim::World> world = options::load_world(o.params.spec.world_file);
  if (!options || !world) {
    return report_error(!options ? options.error().message : world.error().message);
  }
  o.params.solid = solid_named(o.solid);
  const Result<api::TargetSpec> target = studied_target(*world, o.params);
  const Result<std::vector<HitRateBin>> bins = measure_hit_rate(o.params);
  if (!target || !bins) {
    return report_error(!target ? target.error().message : bins.error().message);
  }
  const double size_m = std::min(target->width_m, target->height_m);
  const search::HitRate before = options->search.search.hit_rate;
  const search::HitRate fit = fit_hit_rate(*bins, size_m, before);
  if (const Status ok = save_study(o.common.out, *bins, size_m, fit, before); !ok) {
    return report_error(ok.error().message);
  }
  std::cout << hit_rate_csv(*bins, size_m, fit) << hit_rate_yaml(fit) << std::flush;
  return kExitDone;
}

int run_template_verb(const TemplateOptions& options) {
  const Status done = run_template(options, std::cout);
  return done ? kExitDone : report_error(done.error().message);
}

}  // namespace

Verb add_hit_rate(CLI::App& app) {
  auto o = std::make_shared<HitRateOptions>();
  CLI::App* verb =
      app.add_subcommand("hit-rate", "The recogniser's hit rate against range, and the curve for evidence");
  add_common(*verb, o->common);
  verb->add_option("--world", o->world, "World file, or the name of one in worlds/")->capture_default_str();
  verb->add_option("--solid", o->solid, "A solid of the world instead of its target: sphere, triangular-prism, ...")
      ->check([](const std::string& name) {
        return solid_named(name) ? std::string() : "there is no solid '" + name + "'";
      });
  verb->add_option("--directions", o->params.directions, "Places around the target per range and seed")
      ->check(CLI::Range(1, 360))
      ->capture_default_str();
  verb->add_option("--range-max", o->params.range_max_m, "Farthest place, m")->capture_default_str();
  return [o] { return run_hit_rate(*o); };
}

Verb add_template(CLI::App& app) {
  auto o = std::make_shared<TemplateOptions>();
  CLI::App* verb = app.add_subcommand("template", "The recogniser on photographs, every stage as a picture");
  auto kind = std::make_shared<std::string>("template");
  verb->add_option("-t,--target", o->targets, "Picture of a target, PNG (repeatable)")->required();
  verb->add_option("-s,--scene", o->scene, "Photograph to search, PNG")->required();
  verb->add_option("--out", o->out, "Folder for the pictures of the stages")->required();
  verb->add_option("--recogniser", *kind, "How the targets are recognised")
      ->check(CLI::IsMember({"template", "features"}))
      ->capture_default_str();
  verb->add_option("--width", o->width_m, "Width of the real targets, m")->capture_default_str();
  return [o, kind] {
    o->kind = *kind == "features" ? vision::TargetKind::kFeature : vision::TargetKind::kTemplate;
    return run_template_verb(*o);
  };
}

Verb add_revisit(CLI::App& app) {
  auto o = std::make_shared<RevisitOptions>();
  CLI::App* verb = app.add_subcommand("revisit", "Which photographs of an ordered folder show a place again");
  verb->add_option("folder", o->folder, "Folder with PNG or JPEG files, ordered by the numbers in their names")
      ->required();
  verb->add_option("--out", o->out, "Folder for revisits.csv and a picture of each pair with its inliers")->required();
  verb->add_option("--gap", o->gap, "Photographs that follow each other this closely are no revisit")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  verb->add_option("--min-inliers", o->params.min_inliers, "Matches that must agree on one geometry of two views")
      ->check(CLI::Range(8, 1000))
      ->capture_default_str();
  verb->add_flag("--all", o->all, "List every pair, not only each photograph's best earlier one");
  verb->add_flag("--json", o->json, "Print JSON");
  return [o] {
    if (show_progress()) {
      o->progress = [](std::size_t done, std::size_t all) {
        std::cerr << '\r' << done << " of " << all << " photographs" << (done == all ? "\n" : "") << std::flush;
      };
    }
    const Status done = run_revisit(*o, std::cout);
    return done ? kExitDone : report_error(done.error().message);
  };
}

}  // namespace seeker::lab
