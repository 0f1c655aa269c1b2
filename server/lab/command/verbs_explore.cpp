#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "common/config/number_text.hpp"
#include "common/files/files.hpp"
#include "server/lab/active_slam/explore_experiment.hpp"
#include "server/lab/command/verbs.hpp"
#include "server/lab/efficiency/tour_command.hpp"
#include "server/lab/experiments/seeds.hpp"

namespace seeker::lab {
namespace {

const std::map<std::string, api::ExploreStrategy>& strategies() {
  static const std::map<std::string, api::ExploreStrategy> kByName = [] {
    std::map<std::string, api::ExploreStrategy> by_name;
    for (const api::ExploreStrategy strategy : api::kExploreStrategies) {
      by_name.emplace(to_string(strategy), strategy);
    }
    return by_name;
  }();
  return kByName;
}

struct ExploreOptions {
  CommonOptions common;
  std::vector<std::string> worlds{"corridor"};
  std::vector<std::string> strategies{"active"};
  std::vector<double> bound;
  double time_limit_s = 3600.0;
  double wall_near_m = 0.25;
  bool return_to_start = false;
};

void add_options(CLI::App& verb, ExploreOptions& o) {
  add_common(verb, o.common);
  verb.add_option("--world", o.worlds, "World file, or the name of one in worlds/ (repeatable)")->capture_default_str();
  verb.add_option("--strategy", o.strategies, "How the robot chooses its path (repeatable)")
      ->check(CLI::IsMember(explore_strategies()))
      ->capture_default_str();
  verb.add_option("--time-limit", o.time_limit_s, "Longest robot time of a run, s")
      ->check(config::number_above_zero, "above 0")
      ->capture_default_str();
  verb.add_option("--bound", o.bound,
                  "Explore inside this polygon only: X,Y,X,Y,... in m from the start, x ahead of it")
      ->delimiter(',');
  verb.add_flag("--return-to-start", o.return_to_start, "Drive back when all is explored");
  verb.add_option("--wall-near", o.wall_near_m, "A wall counts as mapped when a segment is so near, m")
      ->check(config::number_above_zero, "above 0")
      ->capture_default_str();
}

Result<std::optional<Polygon>> bound_of(const std::vector<double>& numbers) {
  constexpr std::size_t kSmallest = 6;
  if (numbers.empty()) {
    return std::optional<Polygon>();
  }
  if (numbers.size() % 2 != 0 || numbers.size() < kSmallest) {
    return fail(Errc::kInvalidArgument, "--bound needs pairs X,Y of three corners or more");
  }
  Polygon bound;
  for (std::size_t n = 0; n < numbers.size(); n += 2) {
    bound.emplace_back(numbers[n], numbers[n + 1]);
  }
  return std::optional<Polygon>(std::move(bound));
}

Result<std::vector<ExploreSpec>> specs_of(const ExploreOptions& o) {
  const Result<std::vector<std::uint64_t>> seeds = parse_seeds(o.common.seeds);
  if (!seeds) {
    return tl::unexpected<Error>(seeds.error());
  }
  const Result<std::optional<Polygon>> bound = bound_of(o.bound);
  if (!bound) {
    return tl::unexpected<Error>(bound.error());
  }
  ExploreSpec spec;
  spec.robot_file = robot_file(o.common);
  spec.overrides = o.common.overrides;
  spec.time_limit_s = o.time_limit_s;
  spec.bound = *bound;
  spec.return_to_start = o.return_to_start;
  spec.wall_near_m = o.wall_near_m;
  std::vector<ExploreSpec> specs;
  for (const std::string& world : o.worlds) {
    spec.world_file = world_file(o.common, world);
    for (const std::string& strategy : o.strategies) {
      spec.strategy = strategies().at(strategy);
      const std::vector<ExploreSpec> runs = with_seeds(spec, *seeds);
      specs.insert(specs.end(), runs.begin(), runs.end());
    }
  }
  return specs;
}

Status run(const ExploreOptions& o) {
  const Result<std::vector<ExploreSpec>> specs = specs_of(o);
  if (!specs) {
    return tl::unexpected<Error>(specs.error());
  }
  std::error_code error;
  std::filesystem::create_directories(o.common.out, error);
  const Result<std::vector<ExploreResult>> results =
      explore_missing(*specs, o.common.out, o.common.jobs, show_progress());
  if (!results) {
    return tl::unexpected<Error>(results.error());
  }
  const Table runs = explore_runs_table(*results);
  const Table summary = explore_summary_table(*results);
  if (Status ok = files::write_file(o.common.out / "runs.csv", runs.csv()); !ok) {
    return ok;
  }
  if (Status ok = files::write_file(o.common.out / "summary.csv", summary.csv()); !ok) {
    return ok;
  }
  std::cout << (o.common.json ? explore_json(*results) : summary.text()) << std::flush;
  return {};
}

}  // namespace

std::vector<std::string> explore_strategies() {
  std::vector<std::string> names;
  names.reserve(strategies().size());
  for (const auto& [name, strategy] : strategies()) {
    names.push_back(name);
  }
  return names;
}

Verb add_explore(CLI::App& app) {
  auto o = std::make_shared<ExploreOptions>();
  CLI::App* verb = app.add_subcommand("explore", "Explorations over seeds; numbers, curves and a picture per run");
  add_options(*verb, *o);
  return [o] {
    const Status done = run(*o);
    return done ? kExitDone : report_error(done.error().message);
  };
}

Verb add_tour(CLI::App& app) {
  auto o = std::make_shared<TourOptions>();
  auto common = std::make_shared<CommonOptions>();
  auto building = std::make_shared<std::string>();
  auto start = std::make_shared<std::vector<double>>();
  CLI::App* verb = app.add_subcommand("tour", "What somebody would drive who knows the building: the yardstick");
  verb->add_option("building", *building, "World file, the name of one in worlds/, or the YAML file of a ROS map")
      ->required();
  verb->add_option("--config", common->config, "Folder with worlds/");
  const auto number = [&](const char* name, double& value, const char* help) {
    verb->add_option(name, value, help)->check(config::number_above_zero, "above 0")->capture_default_str();
  };
  number("--range", o->coverage.range_m, "How far the sensor sees, m");
  number("--share", o->coverage.share, "Share of floor and walls that must be seen, 0 to 1");
  number("--step", o->coverage.step_m, "Distance of the viewpoints that are tried, m");
  number("--radius", o->robot_radius_m, "Radius of the robot, m");
  number("--height", o->scanner_height_m, "Height of the sensor over the floor of a world, m");
  verb->add_option("--start", *start, "Where the tour begins: X,Y in m (default: the world's first start, or 0,0)")
      ->delimiter(',')
      ->expected(2);
  verb->add_option("--out", o->picture, "PNG to write (default: none is written)");
  verb->add_flag("--json", o->json, "Print JSON");
  return [o, common, building, start] {
    o->building = world_file(*common, *building);
    if (!start->empty()) {
      o->start = Point2(start->at(0), start->at(1));
    }
    const Status done = run_tour(*o, std::cout);
    return done ? static_cast<int>(kExitDone) : report_error(done.error().message);
  };
}

}  // namespace seeker::lab
